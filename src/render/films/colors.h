// Images as vectors of colours, rows from the top, and the files they are written to.
#pragma once

#include <string>
#include <vector>

#include "src/base/core/vec.h"
#include "src/render/films/accumulator.h"

namespace lanelight {

/// The means of all pixels of a film.
std::vector<Rgb> FilmColors(const FilmAccumulator& film);

/// As it comes back from a file.
inline Rgb RoundToFloat(const Rgb& c) { return VecCast<double>(VecCast<float>(c)); }

/// Channels R, G, B with a prefix before their names.
struct ColorLayer {
  std::string prefix;
  const std::vector<Rgb>* colors;  // empty: left out
};

/// EXR, 32 bit. Throws InputError if it cannot be written.
void WriteColors(const std::string& path, int width, int height,
                 const std::vector<ColorLayer>& layers);

/// R, G, B of an EXR file.
std::vector<Rgb> ReadColors(const std::string& path);

}  // namespace lanelight
