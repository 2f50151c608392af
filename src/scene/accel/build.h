// Builds the BVHs that kernels read (src/scene/geometry/accel.h).
#pragma once

#include <cstdint>

#include "src/base/core/hash.h"
#include "src/scene/accel/bvh_report.h"
#include "src/scene/geometry/accel.h"

namespace lanelight {

struct Geometry;  // src/scene/geometry/geometry.h

/// Options of the build. Tests and benchmarks change the limits of `few_*`.
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

using BvhKey = Hash128;

/// Returns XXH3 (128 bits) of everything that BuildAccel reads: positions of shapes,
/// groups, instances and options.
BvhKey KeyOf(const Geometry& geometry, const AccelOptions& options);

struct CachedBvh {
  BvhKey key;
  Accel accel;
};

struct ReusedBvh {
  Accel accel;
  BvhReport report;
};

/// Returns the tree of `known` (or null) if its shapes are equal; else builds one.
ReusedBvh FindBvh(const Geometry& geometry, const AccelOptions& options,
                  const CachedBvh* known);

}  // namespace lanelight
