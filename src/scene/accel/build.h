// Builds the BVHs that kernels read (src/scene/geometry/accel.h).
#pragma once

#include <cstdint>

#include "src/scene/geometry/accel.h"

namespace lanelight {

struct Geometry;  // src/scene/geometry/geometry.h

/// Options of the build; rendering uses the defaults. Tests and bench change what counts
/// as few.
struct AccelOptions {
  std::uint32_t few_triangles = kFewTriangles;
  std::uint32_t few_round = kFewRound;
  BuildQuality quality = BuildQuality::kHigh;
  int leaf_triangles = kLeafTriangles;  // or half as many: LeafTrianglesFor
};

/// Returns the leaf size that is traced fastest with vectors of this many lanes.
inline constexpr int LeafTrianglesFor(int lanes) {
  return lanes < kLeafTriangles ? SmallLeaf::kLanes : TriangleLeaf::kLanes;
}

/// Builds everything that `geometry` needs. The result does not depend on the number of
/// threads. Shapes with a non-finite coordinate are left out (they cannot be hit).
Accel BuildAccel(const Geometry& geometry, const AccelOptions& options = {});

}  // namespace lanelight
