// Images as vectors of colours, rows from the top, and the files they are written to.
#pragma once

#include <string>
#include <vector>

#include "src/base/core/vec.h"
#include "src/render/films/accumulator.h"

namespace lanelight {

/// Returns the means of all pixels of a film.
std::vector<Rgb> FilmColors(const FilmAccumulator& film);

/// Returns the colour as a file stores it.
inline Rgb RoundToFloat(const Rgb& c) { return VecCast<double>(VecCast<float>(c)); }

/// Channels R, G and B, named with a prefix.
struct ColorLayer {
  std::string prefix;
  const std::vector<Rgb>* colors;  // empty: left out
};

/// Writes an EXR file of 32-bit floats. Throws InputError if it cannot be written.
void WriteColors(const std::string& path, int width, int height,
                 const std::vector<ColorLayer>& layers);

/// Reads R, G and B of an EXR file.
std::vector<Rgb> ReadColors(const std::string& path);

}  // namespace lanelight
