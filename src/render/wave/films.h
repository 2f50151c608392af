// Adds finished samples to the film, and knows which plane of a sample belongs to which
// part of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/base/image/color_spaces.h"
#include "src/base/image/pixel_rect.h"
#include "src/render/films/accumulator.h"
#include "src/vocabulary/path/run_parameters.h"

namespace lanelight {

/// Samples of the pixels of a tile, plane by plane; a pixel's are consecutive.
struct TileSamples {
  PixelRect place;                           // of the tile in the film
  const std::vector<std::uint32_t>& pixels;  // y * width + x
  int width = 0;
  float* values = nullptr;
  std::uint32_t count = 0;  // per pixel
  /// The light of light subpaths in pixels of the film, if it keeps that, and the number
  /// of these subpaths.
  std::vector<PixelSplat>* splats = nullptr;
  std::uint64_t light_paths = 0;
};

class Films {
 public:
  /// `planes`: those of the samples; `coefficient`: that of control=regression. The film
  /// has no samples yet.
  Films(const SamplePlanes& planes, double coefficient, FilmAccumulator& film);

  /// Adds samples, each pixel's in order. Safe for different tiles from different
  /// threads. Changes the values where the film does not respond in linear sRGB.
  void Add(const TileSamples& tile);

  /// Sets how the film responds to light; before any sample.
  void UseResponse(const FilmResponse& response);

  /// Returns all sums by pixel (FilmAccumulator::Columns).
  std::vector<MutableStateColumn> Columns() { return film_.Columns(); }
  const FilmAccumulator& film() const { return film_; }
  FilmAccumulator& film() { return film_; }

 private:
  void Respond(const TileSamples& tile) const;
  void RespondToSplats(std::vector<PixelSplat>& splats) const;

  SamplePlanes planes_;
  FilmAccumulator& film_;
  std::optional<FilmResponse> response_;
};

}  // namespace lanelight
