// Decides which triangles a build cuts, and bounds their parts.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "src/scene/accel/builder.h"
#include "src/scene/accel/partition.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// A triangle with its corners in ascending order along an axis.
class SortedTriangle {
 public:
  SortedTriangle(const TriangleRecord& triangle, int axis) : axis_(axis) {
    // The fourth number is the next corner's first, or the material, and unused.
    for (int k = 0; k < 3; ++k) p_[k] = Load4(triangle.p[k]);
    if (p_[1][axis] < p_[0][axis]) std::swap(p_[0], p_[1]);
    if (p_[2][axis] < p_[1][axis]) std::swap(p_[1], p_[2]);
    if (p_[1][axis] < p_[0][axis]) std::swap(p_[0], p_[1]);
  }

  Float4 corner(int k) const { return p_[k]; }

  /// Returns the box of the section at coordinate `x` of the axis, up to rounding; empty
  /// beyond the corners.
  WideBox Section(float x) const {
    WideBox box;
    if (x < p_[0][axis_] || x > p_[2][axis_]) return box;
    box.Extend(Point(0, 2, x));
    box.Extend(x < p_[1][axis_] ? Point(0, 1, x) : Point(1, 2, x));
    return box;
  }

 private:
  Float4 Point(int a, int b, float x) const {
    const float length = p_[b][axis_] - p_[a][axis_];
    const float t = length > 0 ? (x - p_[a][axis_]) / length : 0.0f;
    return p_[a] + t * (p_[b] - p_[a]);
  }

  Float4 p_[3];
  int axis_;
};

struct CutBoxes {
  AccelBox left, right;  // inverted if there is nothing on that side
};

bool IsEmpty(const AccelBox& box);

/// Returns the boxes, rounded outwards, of the parts of `triangle` in `box` on both sides
/// of the plane where coordinate `axis` is `x`.
CutBoxes CutTriangle(const TriangleRecord& triangle, const AccelBox& box, int axis,
                     float x);

struct CutPlan {
  std::uint32_t room = 0;  // items that may be added
  /// Smallest number of items of a range that may be cut.
  std::uint32_t minimum = std::numeric_limits<std::uint32_t>::max();
  /// A plane is used if it costs less than this times the best split without cuts, in
  /// ranges of at least kLargeRange items and in smaller ones.
  float gain = 0, small_gain = 0;

  float Gain(std::uint32_t count) const {
    return count < kLargeRange ? small_gain : gain;
  }
  static constexpr std::uint32_t kLargeRange = 128;
};

/// Returns a plan for a mesh, by the empty part of the boxes of its triangles. `items`
/// are whole triangles, at least one.
CutPlan PlanCuts(const std::vector<BuildItem>& items, const TriangleRecord* triangles);

}  // namespace lanelight
