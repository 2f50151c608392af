// Sparse grids of numbers in the format of NanoVDB (Museth 2021,
// "NanoVDB: A GPU-Friendly and Portable VDB Data Structure").
#pragma once

#include <cstddef>

#include "src/base/core/transform.h"
#include "src/base/core/vec.h"

namespace lanelight {

/// Voxels are looked up between minus this and this, along each axis.
inline constexpr double kFarthestVoxel = 1e9;
/// Limit of absolute values, so that results computed from them stay finite.
inline constexpr double kLargestVoxel = 1e30;

/// A grid of a file, in memory as the file stores it: quantised values stay quantised.
/// Voxel (i, j, k) has its value at the point (i, j, k) of index space; none is above
/// kLargestVoxel in size.
class SparseGrid {
 public:
  virtual ~SparseGrid() = default;

  /// The value at points of index space, linear between voxels, into `out`. NaN: 0.
  virtual void Interpolate(const float* x, const float* y, const float* z,
                           std::size_t count, float* out) const = 0;
  /// The value of one voxel; the background's where none is stored.
  virtual float Value(int i, int j, int k) const = 0;
  /// The largest value of voxels low to high, both included.
  virtual float LargestIn(const int low[3], const int high[3]) const = 0;

  const Transform& index_from_world() const { return index_from_world_; }
  /// Around all active voxels, in the file's world; with the voxel after the last one.
  /// In index space, no further away than kFarthestVoxel.
  Vec3d box_min() const { return box_min_; }
  Vec3d box_max() const { return box_max_; }
  /// Smallest and largest value of all stored voxels and the background.
  float smallest() const { return smallest_; }
  float largest() const { return largest_; }
  /// Memory in bytes.
  std::size_t bytes() const { return bytes_; }

 protected:
  Transform index_from_world_;
  Vec3d box_min_, box_max_;
  float smallest_ = 0, largest_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace lanelight
