#include "src/accel/instances.h"

#include <algorithm>
#include <cmath>

#include "src/accel/builder.h"
#include "src/accel/grow.h"
#include "src/accel/shape_items.h"

namespace lanelight {
namespace {

// Largest sum of |entries| of a row of the linear part of a 3x4 map.
float RowNorm(const float* m) {
  float norm = 0;
  for (int r = 0; r < 3; ++r) {
    norm = std::max(norm,
                    std::abs(m[4 * r]) + std::abs(m[4 * r + 1]) + std::abs(m[4 * r + 2]));
  }
  return norm;
}

// Box of a transformed box, rounded outwards.
AccelBox Transformed(const float* m, const AccelBox& box) {
  AccelBox result;
  for (int r = 0; r < 3; ++r) {
    double lo = m[4 * r + 3], hi = lo;
    for (int c = 0; c < 3; ++c) {
      const double a = double{m[4 * r + c]} * box.lo[c];
      const double b = double{m[4 * r + c]} * box.hi[c];
      lo += std::min(a, b);
      hi += std::max(a, b);
    }
    result.lo[r] = std::nextafter(static_cast<float>(lo), -INFINITY);
    result.hi[r] = std::nextafter(static_cast<float>(hi), INFINITY);
  }
  return result;
}

}  // namespace

// A hit is found in object space, along a ray that was rounded
// when it was transformed; seen from the scene it may lie outside the instance's box by
//   |S| (4u (|M| (|o| + t) + |m|) + kShapeSlack (reach_g + |M| |o| + |m|)),
// S, M the linear parts of the maps to scene and object, m the translation of M, u =
// 2^-24. The slack of the top level covers that, with norms for the matrices.
Bvh BuildTop(const Geometry& geometry, const std::vector<AccelBox>& group_boxes,
             const std::vector<Bvh>& groups, AlignedVector<WideNode>& nodes) {
  std::vector<BuildItem> items;
  float linear = 1, constant = 0;
  int deepest = 0;
  for (std::uint32_t i = 0; i < geometry.instances.size(); ++i) {
    const std::uint32_t group = geometry.instance_group[i];
    if (groups[group].root == kEmptyRef) continue;
    const InstanceRecord& record = geometry.instances[i];
    BuildItem item{Transformed(record.scene_from_object, group_boxes[group]), i};
    if (!IsFinite(item.box)) continue;
    items.push_back(item);
    const float* m = record.object_from_scene;
    const float translation = std::max({std::abs(m[3]), std::abs(m[7]), std::abs(m[11])});
    const float to_scene = RowNorm(record.scene_from_object);
    linear = std::max(linear, to_scene * RowNorm(m));
    constant = std::max(constant, to_scene * (groups[group].reach + translation));
    deepest = std::max(deepest, groups[group].depth);
  }
  Bvh top = BuildTree(std::move(items),
                      {.items = 0, .fits = {}, .typical = {}, .triangles = nullptr},
                      BuildQuality::kHigh, nodes)
                .bvh;
  // Rays go on into the instances.
  top.depth += deepest;
  if (top.reach > 0) top.slack = 2 * kShapeSlack * (2 * linear + constant / top.reach);
  top.margin = top.slack * top.reach;
  return top;
}

}  // namespace lanelight
