#include "src/scene/compile/media.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "src/base/core/sparse_grid.h"
#include "src/scene/compile/focus.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {
namespace {

// Rounding of the kernels, which the bounds must hold for as well.
constexpr double kSlack = 1 + 1e-5;

// Extinction of a voxel, in the unit of the majorants. What lies between voxels is
// between theirs, in each channel or at each wavelength.
double Extinction(const MediumGrid& grid, Transport transport, std::size_t voxel) {
  if (grid.source == MediumSource::kDensities) return grid.values[voxel];
  if (transport == Transport::kSpectral) {
    VoxelSpectrum both[2];
    std::memcpy(both, grid.values.data() + 8 * voxel, sizeof both);
    return LargestOf(both[0]) + LargestOf(both[1]);
  }
  const float* v = grid.values.data() + 6 * voxel;
  double largest = 0;
  for (int c = 0; c < 3; ++c) largest = std::max(largest, double{v[c]} + v[c + 3]);
  return largest;
}

// Voxels whose samples reach into cell i of the majorant grid.
struct Reach {
  int first, last;
};
Reach VoxelsOf(int cell, int size) {
  const double low = static_cast<double>(cell) / kMajorantCells * size - 0.5;
  const double high = static_cast<double>(cell + 1) / kMajorantCells * size - 0.5;
  // One more on both sides: the kernels round.
  return {std::max(0, static_cast<int>(std::floor(low)) - 1),
          std::min(size - 1, static_cast<int>(std::floor(high)) + 2)};
}

double BoundOfVoxels(const MediumGrid& grid, Transport transport, const int cell[3]) {
  const Reach r[3] = {VoxelsOf(cell[0], grid.size[0]), VoxelsOf(cell[1], grid.size[1]),
                      VoxelsOf(cell[2], grid.size[2])};
  double largest = 0;
  for (int z = r[2].first; z <= r[2].last; ++z) {
    for (int y = r[1].first; y <= r[1].last; ++y) {
      for (int x = r[0].first; x <= r[0].last; ++x) {
        const std::size_t voxel =
            (static_cast<std::size_t>(z) * grid.size[1] + y) * grid.size[0] + x;
        largest = std::max(largest, Extinction(grid, transport, voxel));
      }
    }
  }
  return largest;
}

// Bounds the cloud by height alone, as the octaves sum up to 0.96875 times at most 1.05
// (Noise in kernels/texture/noise-inl.h).
double BoundOfCloud(const CloudShape& cloud, const int cell[3]) {
  const auto height = [&](int i) {
    return cloud.low[1] + cloud.size[1] * static_cast<double>(i) / kMajorantCells;
  };
  const double low = height(cell[1]) - 1e-5 * cloud.size[1];
  const double left = std::max(std::abs(1 - low), std::abs(1 - height(cell[1] + 1)));
  const double lumps = std::min(1.0, 4.5 * cloud.density * left * 1.03);
  return std::min(1.0, lumps + 2 * std::max(0.0, 0.5 - low));
}

double BoundOfSparse(const PlacedSparseGrid& placed, const int cell[3]) {
  int low[3], high[3];
  const float* m = placed.index_from_box;
  for (int r = 0; r < 3; ++r) {
    double minimum = m[4 * r + 3], maximum = minimum;
    for (int c = 0; c < 3; ++c) {
      const double a = m[4 * r + c] * static_cast<double>(cell[c]) / kMajorantCells;
      const double b = m[4 * r + c] * (cell[c] + 1.0) / kMajorantCells;
      minimum += std::min(a, b), maximum += std::max(a, b);
    }
    // The box of two grids may be far from one of them. Nor may a bound be NaN.
    if (!(minimum > -kFarthestVoxel && maximum < kFarthestVoxel))
      return placed.grid->largest();
    // One more on both sides: the kernels round.
    low[r] = static_cast<int>(std::floor(minimum)) - 1;
    high[r] = static_cast<int>(std::floor(maximum)) + 2;
  }
  return placed.grid->LargestIn(low, high);
}

double BoundOf(const MediumGrid& grid, Transport transport, const int cell[3]) {
  if (grid.source == MediumSource::kCloud) return BoundOfCloud(grid.cloud, cell);
  if (grid.source == MediumSource::kSparse) return BoundOfSparse(grid.sparse, cell);
  return BoundOfVoxels(grid, transport, cell);
}

void SetMajorants(Transport transport, MediumGrid& grid) {
  constexpr int n = kMajorantCells;
  for (int i = 0; i < n * n * n; ++i) {
    const int cell[3] = {i % n, i / n % n, i / (n * n)};
    const double bound = BoundOf(grid, transport, cell);
    grid.majorants.push_back(static_cast<float>(bound * kSlack));
  }
}

// Stores two spectra instead of six numbers per voxel.
void SetSpectra(const Medium& medium, double unit, MediumGrid& grid) {
  for (std::size_t v = 0; v < medium.grid.size(); v += 3) {
    Rgb color;
    for (int c = 0; c < 3; ++c) {
      const float value = medium.grid[v + static_cast<std::size_t>(c)];
      color[c] = std::min(value / unit, kFarthestInScene / 2);
    }
    AppendSpectrum(color, grid.values);
  }
}

void SetSource(const Medium& medium, const WorldFrame& frame, Transport transport,
               MediumGrid& grid) {
  if (medium.kind == MediumKind::kNanoVdb) {
    grid.source = MediumSource::kSparse;
    grid.sparse = PlaceSparseGrid(medium.sparse_density, medium);
    return;
  }
  if (medium.kind == MediumKind::kCloud) {
    grid.source = MediumSource::kCloud;
    grid.cloud = {static_cast<float>(medium.density),
                  static_cast<float>(medium.wispiness),
                  static_cast<float>(medium.frequency)};
    Store(medium.box_min, grid.cloud.low);
    Store(medium.box_max - medium.box_min, grid.cloud.size);
    return;
  }
  const bool colors = medium.kind == MediumKind::kRgbGrid;
  grid.source = colors ? MediumSource::kColors : MediumSource::kDensities;
  std::copy(medium.grid_size, medium.grid_size + 3, grid.size);
  // Densities have no unit; coefficients are per scene length.
  const double unit = colors ? frame.scale : 1;
  if (colors && transport == Transport::kSpectral) return SetSpectra(medium, unit, grid);
  grid.values.reserve(medium.grid.size());
  for (const float v : medium.grid) {
    grid.values.push_back(static_cast<float>(std::min(v / unit, kFarthestInScene)));
  }
}

void SetMap(const Medium& medium, const WorldFrame& frame, MediumGrid& grid) {
  const Vec3d size = medium.box_max - medium.box_min;
  const Transform box_from_medium =
      Transform::Scale({1 / size.x, 1 / size.y, 1 / size.z}) *
      Transform::Translate(-medium.box_min);
  const Transform map =
      box_from_medium * medium.world_from_medium.Inverse() * frame.Inverse();
  Store(map, grid.box_from_scene);
  const bool seen = std::all_of(grid.box_from_scene, grid.box_from_scene + 12,
                                [](float v) { return std::abs(v) <= kFarthestInScene; });
  if (seen) return;
  // So small or flat a box is invisible, so it is placed outside of the scene.
  std::fill_n(grid.box_from_scene, 12, 0.0f);
  grid.box_from_scene[3] = -1;
}

}  // namespace

MediumGrid CompileMediumGrid(const Medium& medium, const WorldFrame& frame,
                             Transport transport) {
  MediumGrid grid;
  SetSource(medium, frame, transport, grid);
  grid.emission = CompileMediumEmission(medium, transport);
  SetMajorants(transport, grid);
  SetMap(medium, frame, grid);
  return grid;
}

}  // namespace lanelight
