// What finished samples go to: the film, and that of a control variate that is fitted to
// them. Knows which plane of a sample is whose.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/base/image/color_spaces.h"
#include "src/base/image/pixel_rect.h"
#include "src/render/films/accumulator.h"
#include "src/vocabulary/path/sample_planes.h"

namespace lanelight {

/// Samples of the pixels of a tile, plane by plane; a pixel's are consecutive.
struct TileSamples {
  PixelRect place;                           // of the tile in the film
  const std::vector<std::uint32_t>& pixels;  // y * width + x
  int width = 0;
  float* values = nullptr;
  std::uint32_t count = 0;  // per pixel
};

class Films {
 public:
  /// Samples have `planes`; `coefficient`: of control=regression. Before any sample.
  Films(const SamplePlanes& planes, double coefficient, FilmAccumulator& film);

  /// Adds samples, each pixel's in order. Safe for different tiles from different
  /// threads. Values are changed where a control variate corrects them, or the film
  /// responds otherwise than in linear sRGB.
  void Add(const TileSamples& tile);

  /// From here on (before any sample) the film responds to light like this.
  void UseResponse(const FilmResponse& response);

  /// All that Add has brought, by pixel of the film, row by row: films of the same
  /// pixels, planes and groups that are given these go on from there.
  std::vector<MutableStateColumn> Columns() { return film_.Columns(); }
  const FilmAccumulator& film() const { return film_; }
  FilmAccumulator& film() { return film_; }

 private:
  void Respond(const TileSamples& tile) const;

  SamplePlanes planes_;
  FilmAccumulator& film_;
  std::optional<FilmResponse> response_;
};

}  // namespace lanelight
