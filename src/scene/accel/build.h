// Builds the trees over shapes that kernels read (src/scene/geometry/accel.h).
#pragma once

#include <cstdint>

#include "src/scene/geometry/accel.h"

namespace lanelight {

struct Geometry;  // src/scene/geometry/geometry.h

/// How to build; the defaults are what rendering uses. What counts as few serves tests
/// and bench.
struct AccelOptions {
  std::uint32_t few_triangles = kFewTriangles;
  std::uint32_t few_round = kFewRound;
  BuildQuality quality = BuildQuality::kHigh;
  int leaf_triangles = kLeafTriangles;  // or half as many: LeafTrianglesFor
};

/// What is traced fastest with vectors of so many lanes.
inline constexpr int LeafTrianglesFor(int lanes) {
  return lanes < kLeafTriangles ? SmallLeaf::kLanes : TriangleLeaf::kLanes;
}

/// Builds everything that `geometry` needs. The result does not depend on the number of
/// threads. Shapes with a non-finite coordinate are left out (they cannot be hit).
Accel BuildAccel(const Geometry& geometry, const AccelOptions& options = {});

}  // namespace lanelight
