// What finished samples go to: the film, and that of a control variate that is fitted to
// them. Knows which plane of a sample is whose.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/image/accumulator.h"
#include "src/image/pixel_rect.h"
#include "src/image/regression_film.h"
#include "src/path/sample_planes.h"

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

  /// Changes the size of the groups, see FilmAccumulator::Regroup.
  void Regroup(std::uint32_t group_size);

  /// Adds samples, each pixel's in order. Safe for different tiles from different
  /// threads. Values are changed where a control variate corrects them.
  void Add(const TileSamples& tile);

  std::optional<ControlReport> Control() const;

  // All that Add has brought, exactly (src/core/state.h); films of the same size, planes
  // and group size go on from there. Throws InputError for a state of others.
  void Save(StateWriter& state) const;
  void Restore(StateReader& state);

 private:
  SamplePlanes planes_;
  FilmAccumulator& film_;
  std::optional<RegressionFilm> regression_;
};

}  // namespace lanelight
