#include "src/scene/compile/medium_emission.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/core/sparse_grid.h"
#include "src/base/image/spectrum.h"
#include "src/scene/compile/store.h"
#include "src/scene/compile/voxel_spectra.h"

namespace lanelight {
namespace {

// Entries are evenly spaced in the logarithm of the temperature, from 100 to 20000
// kelvin, and interpolated linearly. Above 1000 kelvin channels are within 0.1 % of the
// brightest one (tests/scene/compile/medium_emission_test.cc).
constexpr int kEntries = 4096;

// Of temperatures up to `largest`, before offset and scale.
void AddColors(const Medium& medium, double largest, BlackbodyTable& table) {
  const double kelvin =
      (largest - medium.temperature_offset) * medium.temperature_scale * (1 + 1e-5);
  const double most = std::max(kelvin, 1.01 * kLeastKelvin);
  const double step = std::log(most / kLeastKelvin) / (kEntries - 1);
  table.entries_per_log = static_cast<float>(1 / step);
  table.colors.reserve(3 * kEntries);
  for (int i = 0; i < kEntries; ++i) {
    const Rgb color = RgbOfBlackbody(kLeastKelvin * std::exp(step * i));
    for (int c = 0; c < 3; ++c) table.colors.push_back(static_cast<float>(color[c]));
  }
}

}  // namespace

PlacedSparseGrid PlaceSparseGrid(std::shared_ptr<const SparseGrid> grid,
                                 const Medium& medium) {
  PlacedSparseGrid placed;
  const Transform map = grid->index_from_world() * Transform::Translate(medium.box_min) *
                        Transform::Scale(medium.box_max - medium.box_min);
  Store(map, placed.index_from_box);
  placed.grid = std::move(grid);
  return placed;
}

MediumEmission CompileMediumEmission(const Medium& medium, Transport transport) {
  MediumEmission emission;
  if (medium.emission == Rgb{}) return emission;
  const bool colors = medium.kind == MediumKind::kRgbGrid;
  const auto& e = medium.emission_grid;
  const bool single = !colors && e.size() == 1;
  for (int a = 0; a < 3; ++a) emission.size[a] = single ? 1 : medium.grid_size[a];
  if (colors && transport == Transport::kSpectral) {
    emission.channels = 4;
    for (std::size_t v = 0; v < e.size(); v += 3) {
      AppendSpectrum({e[v], e[v + 1], e[v + 2]}, emission.values);
    }
  } else {
    emission.channels = colors ? 3 : 1;
    emission.values.assign(e.begin(), e.end());
  }
  double largest = 0;
  if (!medium.temperature.empty()) {
    const auto& t = medium.temperature;
    emission.temperatures.assign(t.begin(), t.end());
    largest = *std::max_element(t.begin(), t.end());
  } else if (medium.sparse_temperature != nullptr) {
    emission.sparse = PlaceSparseGrid(medium.sparse_temperature, medium);
    largest = medium.sparse_temperature->largest();
  }
  if (!emission.heated()) return emission;
  emission.blackbody.offset = static_cast<float>(medium.temperature_offset);
  emission.blackbody.scale = static_cast<float>(medium.temperature_scale);
  if (transport == Transport::kRgb) AddColors(medium, largest, emission.blackbody);
  return emission;
}

}  // namespace lanelight
