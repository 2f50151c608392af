#include "src/compile/medium_grid.h"

#include <algorithm>
#include <cmath>

#include "src/core/check.h"

namespace lanelight {
namespace {

// Extinction of a voxel, in the unit of the majorants.
double Extinction(const MediumGrid& grid, std::size_t voxel) {
  const float* v = grid.values.data() + voxel * static_cast<std::size_t>(grid.channels);
  if (grid.channels == 1) return v[0];
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

float MajorantOf(const MediumGrid& grid, const Reach r[3]) {
  double largest = 0;
  for (int z = r[2].first; z <= r[2].last; ++z) {
    for (int y = r[1].first; y <= r[1].last; ++y) {
      for (int x = r[0].first; x <= r[0].last; ++x) {
        const std::size_t voxel =
            (static_cast<std::size_t>(z) * grid.size[1] + y) * grid.size[0] + x;
        largest = std::max(largest, Extinction(grid, voxel));
      }
    }
  }
  return static_cast<float>(largest * (1 + 1e-5));
}

void SetMajorants(MediumGrid& grid) {
  grid.majorants.reserve(kMajorantCells * kMajorantCells * kMajorantCells);
  for (int z = 0; z < kMajorantCells; ++z) {
    for (int y = 0; y < kMajorantCells; ++y) {
      for (int x = 0; x < kMajorantCells; ++x) {
        const Reach reach[3] = {VoxelsOf(x, grid.size[0]), VoxelsOf(y, grid.size[1]),
                                VoxelsOf(z, grid.size[2])};
        grid.majorants.push_back(MajorantOf(grid, reach));
      }
    }
  }
}

void SetMap(const Medium& medium, const Frame& frame, MediumGrid& grid) {
  const Vec3d size = medium.box_max - medium.box_min;
  const Transform box_from_medium =
      Transform::Scale({1 / size.x, 1 / size.y, 1 / size.z}) *
      Transform::Translate(-medium.box_min);
  const Transform map =
      box_from_medium * medium.world_from_medium.Inverse() * frame.Inverse();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) {
      grid.box_from_scene[4 * r + c] = static_cast<float>(map(r, c));
    }
  }
}

}  // namespace

MediumGrid CompileMediumGrid(const Medium& medium, const Frame& frame) {
  MediumGrid grid;
  std::copy(medium.grid_size, medium.grid_size + 3, grid.size);
  grid.channels = medium.kind == MediumKind::kRgbGrid ? 6 : 1;
  // Densities have no unit; coefficients are per scene length.
  const double unit = grid.channels == 1 ? 1 : frame.scale;
  grid.values.reserve(medium.grid.size());
  for (const float v : medium.grid) grid.values.push_back(static_cast<float>(v / unit));
  SetMajorants(grid);
  SetMap(medium, frame, grid);
  return grid;
}

}  // namespace lanelight
