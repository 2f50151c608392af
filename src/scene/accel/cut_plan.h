// Whether, and how much, a build cuts triangles.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "src/scene/accel/builder.h"

namespace lanelight {

struct CutPlan {
  std::uint32_t room = 0;  // items that may be added
  /// Items of the smallest range that may be cut.
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  /// A plane is taken if it costs less than this times the best split without cuts: in
  /// ranges of kLargeRange items and more, and in smaller ones.
  float gain = 0, small_gain = 0;

  float Gain(std::uint32_t count) const {
    return count < kLargeRange ? small_gain : gain;
  }
  static constexpr std::uint32_t kLargeRange = 128;
};

/// A plan for a mesh, by how much of the boxes of its triangles is empty. `items`, not
/// none of them, are whole triangles.
CutPlan PlanCuts(const std::vector<BuildItem>& items, const TriangleRecord* triangles);

}  // namespace lanelight
