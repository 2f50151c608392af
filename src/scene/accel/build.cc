#include "src/scene/accel/build.h"
#include "src/scene/geometry/accel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/scene/accel/builder.h"
#include "src/scene/accel/curve_pieces.h"
#include "src/scene/accel/leaf_blocks.h"
#include "src/scene/accel/shape_items.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {
namespace {

constexpr std::size_t kGrain = 512;

// Builds the tree over `items` and appends its leaves to `blocks`.
template <typename Blocks>
Bvh BuildShapes(std::vector<BuildItem> items, const LeafLimit& limit,
                BuildQuality quality, Blocks blocks, AlignedVector<WideNode>& nodes) {
  const auto first_node = nodes.size();
  BuiltBvh tree = BuildTree(std::move(items), limit, quality, nodes);
  tree.bvh.slack = kShapeSlack;
  std::vector<std::uint32_t> refs;
  refs.reserve(tree.leaves.size());
  for (const LeafRange& leaf : tree.leaves) {
    refs.push_back(kLeafBit | blocks.Place(leaf.capacity));
  }
  blocks.MakeRoom();
  ParallelForRange(refs.size(), kGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const LeafRange leaf = tree.leaves[i];
      std::uint32_t* ids = &tree.ids[leaf.begin];
      std::sort(ids, ids + (leaf.end - leaf.begin));
      blocks.Fill(refs[i] & ~kLeafBit, ids, leaf.end - leaf.begin);
    }
  });
  // Leaf references are places in tree.leaves so far.
  const auto translate = [&](std::uint32_t& ref) {
    if (ref != kEmptyRef && (ref & kLeafBit)) ref = refs[ref & ~kLeafBit];
  };
  translate(tree.bvh.root);
  for (std::size_t n = first_node; n < nodes.size(); ++n) {
    for (std::uint32_t& child : nodes[n].child) translate(child);
  }
  return tree.bvh;
}

FewTriangles MakeFew(const Geometry& geometry, Geometry::TriangleGroup group) {
  FewTriangles few;
  std::map<std::tuple<float, float, float>, std::uint32_t> index;
  for (std::uint32_t id = group.begin; id < group.end; ++id) {
    const TriangleRecord& record = geometry.triangles[id];
    if (!IsFinite(BoxOf(record))) continue;
    FewTriangles::Triangle triangle{{}, id};
    for (int k = 0; k < 3; ++k) {
      const float* p = record.p[k];
      const auto next = static_cast<std::uint32_t>(few.vertices.size());
      const auto [it, inserted] = index.try_emplace({p[0], p[1], p[2]}, next);
      if (inserted) few.vertices.push_back({p[0], p[1], p[2]});
      triangle.vertex[k] = it->second;
      for (int a = 0; a < 3; ++a) few.reach = std::max(few.reach, std::abs(p[a]));
    }
    few.triangles.push_back(triangle);
  }
  return few;
}

void BuildTriangles(const Geometry& geometry, const AccelOptions& options, Accel& accel,
                    AlignedVector<WideNode>& nodes) {
  AlignedVector<TriangleBlock> blocks;
  std::vector<AccelBox> boxes;
  const LeafLimit limit = TriangleLimit(geometry.triangles, options.leaf_triangles);
  for (const Geometry::TriangleGroup& group : geometry.groups) {
    const bool few = boxes.empty() && geometry.instances.empty() &&
                     group.end - group.begin <= options.few_triangles;
    boxes.emplace_back();
    if (few) accel.few = MakeFew(geometry, group);
    auto items = ItemsOf(geometry.triangles, group.begin, group.end, group.begin);
    if (!geometry.instances.empty()) {
      for (const BuildItem& item : items) boxes.back().Extend(item.box);
    }
    accel.groups.push_back(BuildShapes(
        std::move(items), limit, options.quality,
        TriangleBlocks(blocks, geometry.triangles, options.leaf_triangles), nodes));
  }
  accel.top = BuildTop(geometry, boxes, accel.groups, nodes);
  accel.triangle_blocks = std::move(blocks);
}

}  // namespace

Accel BuildAccel(const Geometry& geometry, const AccelOptions& options) {
  LL_CHECK_LE(options.few_triangles, kFewTriangles);  // kernels size their scratch by it
  Accel accel;
  accel.quality = options.quality;
  accel.leaf_triangles = options.leaf_triangles;
  AlignedVector<WideNode> nodes;
  AlignedVector<SphereBlock> sphere_blocks;
  AlignedVector<DiskBlock> disk_blocks;
  BuildTriangles(geometry, options, accel, nodes);
  // Builds the tree over all records, unless there are at most `few` of them.
  const auto build = [&](const auto& records, std::uint32_t first, std::uint32_t few,
                         auto& blocks) {
    const auto count = static_cast<std::uint32_t>(records.size());
    if (count <= few) return Bvh();
    return BuildShapes(ItemsOf(records, 0, count, first), LeafLimit(), options.quality,
                       RoundBlocks(blocks, records, first), nodes);
  };
  accel.spheres =
      build(geometry.spheres, geometry.ranges.spheres, options.few_round, sphere_blocks);
  accel.disks =
      build(geometry.disks, geometry.ranges.disks, options.few_round, disk_blocks);
  AlignedVector<CurveBlock> curve_blocks;
  accel.curves = build(PiecesOf(geometry, geometry.ranges.curves), 0, 0, curve_blocks);
  accel.nodes = std::move(nodes);
  accel.curve_blocks = std::move(curve_blocks);
  accel.sphere_blocks = std::move(sphere_blocks);
  accel.disk_blocks = std::move(disk_blocks);
  return accel;
}

std::size_t Accel::Bytes() const {
  const auto bytes_of = [](const auto&... arrays) {
    return ((arrays.size() * sizeof(*arrays.data())) + ...);
  };
  return sizeof(*this) + bytes_of(nodes, few.vertices, few.triangles, triangle_blocks,
                                  groups, sphere_blocks, disk_blocks, curve_blocks);
}

}  // namespace lanelight
