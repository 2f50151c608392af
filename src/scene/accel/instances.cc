#include "src/scene/accel/builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/base/core/parallel.h"
#include "src/scene/accel/shape_items.h"

namespace lanelight {
namespace {

// Returns the largest sum of |entries| over the rows of the linear part of a 3x4 map.
float RowNorm(const float* m) {
  float norm = 0;
  for (int r = 0; r < 3; ++r) {
    norm = std::max(norm,
                    std::abs(m[4 * r]) + std::abs(m[4 * r + 1]) + std::abs(m[4 * r + 2]));
  }
  return norm;
}

// Boxes whose union holds the triangles of a group.
using Hull = std::vector<AccelBox>;
// Boxes in a hull, and maps of boxes of all instances together, at most.
constexpr std::size_t kHullBoxes = 384, kHullMaps = std::size_t{1} << 26;
constexpr std::size_t kInstanceGrain = 256;

// Returns the corners of the triangles as boxes without extent.
Hull Corners(const Geometry& geometry, Geometry::TriangleGroup group) {
  Hull hull;
  for (std::uint32_t id = group.begin; id < group.end; ++id) {
    const TriangleRecord& triangle = geometry.triangles[id];
    if (!IsFinite(BoxOf(triangle))) continue;
    for (const auto& p : triangle.p) {
      hull.push_back({{p[0], p[1], p[2]}, {p[0], p[1], p[2]}});
    }
  }
  return hull;
}

// Returns the boxes of the deepest levels of the tree that have at most `limit` boxes.
Hull TreeBoxes(const Bvh& bvh, const AccelBox& box, std::size_t limit,
               const AlignedVector<WideNode>& nodes) {
  std::vector<std::pair<std::uint32_t, AccelBox>> open = {{bvh.root, box}};
  Hull hull;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto [ref, own] = open[i];
    const std::size_t left = open.size() - i + hull.size();
    if ((ref & kLeafBit) || left - 1 + kBvhWidth > limit) {
      hull.push_back(own);
      continue;
    }
    const WideNode& node = nodes[ref];
    for (int c = 0; c < kBvhWidth; ++c) {
      if (node.child[c] == kEmptyRef) continue;
      AccelBox child;
      for (int a = 0; a < 3; ++a) {
        child.lo[a] = node.bounds[a][0][c];
        child.hi[a] = node.bounds[a][1][c];
      }
      open.emplace_back(node.child[c], child);
    }
  }
  return hull;
}

// Returns the bounds of the instances of a group. A rotated box can be twice as large as
// the box of its content, and rays enter every instance whose box they meet.
Hull HullOf(const Geometry& geometry, std::uint32_t group, const Bvh& bvh,
            const AccelBox& box, const AlignedVector<WideNode>& nodes) {
  const std::size_t maps =
      geometry.instances.size() + kMotionParts * geometry.motions.size();
  const std::size_t boxes_per_map = kHullMaps / maps;
  const std::size_t limit = std::clamp(boxes_per_map, std::size_t{1}, kHullBoxes);
  const Geometry::TriangleGroup range = geometry.groups[group];
  if (3 * std::size_t{range.end - range.begin} <= limit) return Corners(geometry, range);
  return TreeBoxes(bvh, box, limit, nodes);
}

// Returns the box of the transformed boxes, rounded outwards.
template <typename Number>
AccelBox Transformed(const Number* m, const Hull& hull) {
  AccelBox result;
  for (int r = 0; r < 3; ++r) {
    double minimum = INFINITY, largest = -INFINITY;
    for (const AccelBox& box : hull) {
      double lo = m[4 * r + 3], hi = lo;
      for (int c = 0; c < 3; ++c) {
        const double a = double{m[4 * r + c]} * double{box.lo[c]};
        const double b = double{m[4 * r + c]} * double{box.hi[c]};
        lo += std::min(a, b);
        hi += std::max(a, b);
      }
      minimum = std::min(minimum, lo);
      largest = std::max(largest, hi);
    }
    result.lo[r] = std::nextafter(static_cast<float>(minimum), -INFINITY);
    result.hi[r] = std::nextafter(static_cast<float>(largest), INFINITY);
  }
  return result;
}

std::array<double, 12> MapAt(const Motion& motion, double s) {
  const Transform t = motion.At(s);
  std::array<double, 12> m;
  for (int i = 0; i < 12; ++i) m[static_cast<std::size_t>(i)] = t(i / 4, i % 4);
  return m;
}

// Returns the box of the boxes during the whole motion.
AccelBox Swept(const Motion& motion, const Hull& hull) {
  AccelBox box;
  float reach = 0;
  for (const AccelBox& own : hull) reach = std::max(reach, Reach(own));
  for (int i = 0; i <= motion.Parts(); ++i) {
    const double s = static_cast<double>(i) / motion.Parts();
    box.Extend(Transformed(MapAt(motion, s).data(), hull));
  }
  const auto by = static_cast<float>(motion.Deviation(double{reach}));
  return {box.lo - Vec3f{by, by, by}, box.hi + Vec3f{by, by, by}};
}

std::vector<AccelBox> InstanceBoxes(const Geometry& geometry,
                                    const std::vector<AccelBox>& group_boxes,
                                    const std::vector<Bvh>& groups,
                                    const AlignedVector<WideNode>& nodes) {
  std::vector<Hull> hulls(groups.size());
  for (const std::uint32_t group : geometry.instance_group) {
    if (groups[group].root == kEmptyRef || !hulls[group].empty()) continue;
    hulls[group] = HullOf(geometry, group, groups[group], group_boxes[group], nodes);
  }
  std::vector<AccelBox> boxes(geometry.instances.size());
  ParallelForRange(boxes.size(), kInstanceGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const Hull& hull = hulls[geometry.instance_group[i]];
      boxes[i] = i < geometry.motions.size()
                     ? Swept(MotionOf(geometry.motions[i]), hull)
                     : Transformed(geometry.instances[i].scene_from_object, hull);
    }
  });
  return boxes;
}

// Largest growth of lengths by the maps to scene and object, and the largest translation
// of the map to the object.
struct Growth {
  float to_scene, to_object, translation;
};

Growth GrowthOf(const InstanceRecord& record) {
  const float* m = record.object_from_scene;
  return {RowNorm(record.scene_from_object), RowNorm(m),
          std::max({std::abs(m[3]), std::abs(m[7]), std::abs(m[11])})};
}

// The stretch is largest at one of the ends. Maps that kernels interpolate in time are
// rounded more often than precomputed ones, hence twice the norms.
Growth GrowthOf(const Motion& motion) {
  const auto norm = [](const Transform& t) {
    double sum = 0;
    for (int i = 0; i < 9; ++i) sum += t(i / 3, i % 3) * t(i / 3, i % 3);
    return std::sqrt(3 * sum);
  };
  double to_scene = 0, to_object = 0;
  for (const double s : {0.0, 1.0}) {
    const Transform t = motion.At(s);
    to_scene = std::max(to_scene, norm(t));
    to_object = std::max(to_object, norm(t.Inverse()));
  }
  const double move = Length(motion.from) + Length(motion.way);
  return {static_cast<float>(2 * to_scene), static_cast<float>(to_object),
          static_cast<float>(to_object * move + Length(motion.pivot))};
}

}  // namespace

// A hit is found in object space, along a ray that was rounded
// when it was transformed; seen from the scene it may lie outside the instance's box by
//   |S| (4u (|M| (|o| + t) + |m|) + kShapeSlack (reach_g + |M| |o| + |m|)),
// S, M the linear parts of the maps to scene and object, m the translation of M, u =
// 2^-24. The slack of the top level covers that, with norms for the matrices.
Bvh BuildTop(const Geometry& geometry, const std::vector<AccelBox>& group_boxes,
             const std::vector<Bvh>& groups, AlignedVector<WideNode>& nodes) {
  const std::vector<AccelBox> boxes = InstanceBoxes(geometry, group_boxes, groups, nodes);
  std::vector<BuildItem> items;
  float linear = 1, constant = 0;
  int deepest = 0;
  for (std::uint32_t i = 0; i < geometry.instances.size(); ++i) {
    const std::uint32_t group = geometry.instance_group[i];
    if (groups[group].root == kEmptyRef) continue;
    if (!IsFinite(boxes[i])) continue;
    items.push_back({boxes[i], i});
    const Growth growth = i < geometry.motions.size()
                              ? GrowthOf(MotionOf(geometry.motions[i]))
                              : GrowthOf(geometry.instances[i]);
    linear = std::max(linear, growth.to_scene * growth.to_object);
    constant =
        std::max(constant, growth.to_scene * (groups[group].reach + growth.translation));
    deepest = std::max(deepest, groups[group].depth);
  }
  Bvh top = BuildTree(std::move(items),
                      {.items = 0, .fits = {}, .typical = {}, .triangles = nullptr},
                      BuildQuality::kHigh, nodes)
                .bvh;
  // Traversal continues in the trees of the instances.
  top.depth += deepest;
  if (top.reach > 0) top.slack = 2 * kShapeSlack * (2 * linear + constant / top.reach);
  top.margin = top.slack * top.reach;
  return top;
}

}  // namespace lanelight
