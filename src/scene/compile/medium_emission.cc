#include "src/scene/compile/media.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/core/sparse_grid.h"
#include "src/base/image/spectrum.h"
#include "src/base/image/upsampling.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {

namespace {

// Entries are evenly spaced in the logarithm of the temperature, from 100 to 20000
// kelvin, and interpolated linearly. Above 1000 kelvin channels are within 0.1 % of the
// brightest one (tests/scene/compile/medium_emission_test.cc).
constexpr int kEntries = 4096;

// Adds the colours of temperatures up to `largest`, before offset and scale.
void AddColors(const Medium& medium, double largest, BlackbodyTable& table) {
  const double kelvin =
      (largest - medium.temperature_offset) * medium.temperature_scale * (1 + 1e-5);
  const double max_kelvin = std::max(kelvin, 1.01 * kMinKelvin);
  const double step = std::log(max_kelvin / kMinKelvin) / (kEntries - 1);
  table.entries_per_log = static_cast<float>(1 / step);
  table.colors.reserve(3 * kEntries);
  for (int i = 0; i < kEntries; ++i) {
    const Rgb color = RgbOfBlackbody(kMinKelvin * std::exp(step * i));
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
    largest = *std::ranges::max_element(t);
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

VoxelSpectrum SpectrumOfVoxel(Rgb color) {
  const double scale = 2 * std::max({color.x, color.y, color.z});
  VoxelSpectrum spectrum = {{0, 0, 0}, static_cast<float>(scale)};
  const bool grey = color.x == color.y && color.y == color.z;
  if (grey || !(scale > 0)) return spectrum;
  const SigmoidSpectrum shape = SigmoidByTable(color / scale);
  for (std::size_t k = 0; k < 3; ++k) spectrum.c[k] = static_cast<float>(shape.c[k]);
  return spectrum;
}

void AppendSpectrum(Rgb color, AlignedVector<float>& values) {
  const VoxelSpectrum s = SpectrumOfVoxel(color);
  values.insert(values.end(), {s.c[0], s.c[1], s.c[2], s.scale});
}

// A sigmoid grows with its argument, and a quadratic is largest at an end of the range or
// where its slope is 0. Both multiply-adds of a kernel, and the rounded position, err by
// about 2^-24 of the sum of the coefficients. A sigmoid has a slope of at most 1/2.
double LargestOf(const VoxelSpectrum& spectrum) {
  static const double low = SigmoidPlace(CarriedWavelengths().centre.front());
  static const double high = SigmoidPlace(CarriedWavelengths().centre.back());
  const double c0 = spectrum.c[0], c1 = spectrum.c[1], c2 = spectrum.c[2];
  const auto at = [&](double t) { return (c0 * t + c1) * t + c2; };
  double max_kelvin = std::max(at(low), at(high));
  const double flat = -c1 / (2 * c0);
  if (flat > low && flat < high) max_kelvin = std::max(max_kelvin, at(flat));
  const double rounding = (std::abs(c0) + std::abs(c1) + std::abs(c2)) * 0x1p-23;
  const double sigmoid = 0.5 + 0.5 * max_kelvin / std::sqrt(1 + max_kelvin * max_kelvin);
  return spectrum.scale * std::min(1.0, sigmoid + rounding);
}

}  // namespace lanelight
