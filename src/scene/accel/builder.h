// Binned SAH construction of a binary tree over boxes, collapsed to wide nodes.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

struct AccelBox {
  Vec3f lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};

  void Extend(Vec3f p) {
    lo = Min(lo, p);
    hi = Max(hi, p);
  }
  void Extend(const AccelBox& b) {
    lo = Min(lo, b.lo);
    hi = Max(hi, b.hi);
  }
  /// Half the surface area; 0 for an empty box.
  float HalfArea() const {
    const Vec3f e = hi - lo;
    return e.x >= 0 ? e.x * e.y + e.y * e.z + e.z * e.x : 0.0f;
  }
};

struct TriangleRecord;  // src/scene/geometry/geometry.h

/// A shape to sort into the tree.
struct BuildItem {
  AccelBox box;
  std::uint32_t id = 0;
  /// Twice the centre of the box.
  Vec3f Center2() const { return box.lo + box.hi; }
};

/// Shapes of one leaf: BuiltBvh::ids[begin, end). `capacity`: how many a leaf of its
/// kind holds.
struct LeafRange {
  std::uint32_t begin = 0, end = 0, capacity = 0;
};

struct BuiltBvh {
  Bvh bvh;                         // leaf references index `leaves`
  std::vector<LeafRange> leaves;   // in the order of the tree
  std::vector<std::uint32_t> ids;  // of the items of leaf after leaf
};

/// Limits of a leaf: at most `items` shapes for which `fits` is true, if it is set (0:
/// one shape, and leaf references are item ids). `capacity` is the value of `typical`.
struct LeafLimit {
  std::uint32_t items = kBvhWidth;
  /// Cost of one level of the binary tree relative to testing one leaf: a wide node holds
  /// about three levels.
  float node_cost = 0.35f;
  std::function<bool(const BuildItem* items, std::uint32_t count, std::uint32_t capacity)>
      fits;
  /// If set: how many of these shapes a leaf holds, at a guess, in [1, items].
  std::function<std::uint32_t(const BuildItem* items, std::uint32_t count)> typical;
  /// If set, items are triangles, which the builder may cut: then several items, in
  /// different leaves, have the same id, and their boxes together cover the triangle.
  const TriangleRecord* triangles = nullptr;
};

/// Sorts `items` into a tree whose leaves keep to `limit` and appends its nodes to
/// `nodes`. Runs in parallel; the result does not depend on the number of threads.
BuiltBvh BuildTree(std::vector<BuildItem> items, const LeafLimit& limit,
                   BuildQuality quality, AlignedVector<WideNode>& nodes);

/// Appends its nodes to `nodes`. `group_boxes` bound the triangles of each group,
/// `groups` are their trees. The depth of the result counts the nodes below instances
/// too.
Bvh BuildTop(const Geometry& geometry, const std::vector<AccelBox>& group_boxes,
             const std::vector<Bvh>& groups, AlignedVector<WideNode>& nodes);

}  // namespace lanelight
