#include "src/scene/accel/builder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/scene/accel/binary_tree.h"
#include "src/scene/accel/partition.h"
#include "src/scene/accel/shape_items.h"
#include "src/scene/accel/splits.h"
#include "src/scene/accel/triangle_cut.h"

namespace lanelight {
namespace {

// Ranges smaller than this are built by one thread.
constexpr std::uint32_t kSerial = 2048;
// Below this size of a range the number of items per leaf is estimated.
constexpr std::uint32_t kSerialItems = 64;
// Below this depth ranges are halved instead, which bounds the depth of any tree.
constexpr int kMaxSahDepth = 40;
// Planes that cut triangles are tried where the boxes of the best object split have more
// than this part of the area in common.
constexpr float kOverlap = 0.05f;

class TreeBuilder {
 public:
  TreeBuilder(std::vector<BuildItem>& items, const LeafLimit& limit, const CutPlan& cuts,
              bool one_axis)
      : items_(items.data()),
        limit_(limit),
        cuts_(cuts),
        leaf_size_(std::max(1u, limit.items)),
        one_axis_(one_axis),
        tree_(items.size()) {}

  // Fills the subtree at `node` over the items of `range`. `leaf` is the number of items
  // per leaf, or 0 if it is not known yet.
  void Build(std::uint32_t node, ItemRange range, std::uint32_t leaf, int depth) {
    BinaryNode& n = tree_[node];
    if (leaf == 0 && range.count() <= kSerialItems) {
      leaf = limit_.typical ? limit_.typical(items_ + range.begin, range.count())
                            : leaf_size_;
    }
    const std::uint32_t middle = Divide(n.box, range, leaf, depth);
    n.begin = range.begin;
    n.end = range.end;
    n.capacity = leaf;
    if (middle != range.begin) {
      n.child = tree_.AddPair();
      const ItemRange second = DistributeRoom(range, middle);
      const auto left = [&] { Build(n.child, range, leaf, depth + 1); };
      const auto right = [&] { Build(n.child + 1, second, leaf, depth + 1); };
      if (n.end - n.begin > kSerial) {
        ParallelInvoke(left, right);
      } else {
        left();
        right();
      }
      n.height = std::max(tree_[n.child].height, tree_[n.child + 1].height) + 1;
    } else if (limit_.triangles != nullptr) {
      n.area = SurfaceOf(range);
    }
    PlanCollapse(tree_, node);
  }

  BinaryTree& tree() { return tree_; }

 private:
  // Measures the box of `range` and sorts its items to two sides, maybe cutting some;
  // returns where the second begins, or range.begin if the items make a leaf.
  std::uint32_t Divide(AccelBox& box, ItemRange& range, std::uint32_t leaf, int depth) {
    const std::uint32_t block = leaf == 0 ? leaf_size_ : leaf;
    AccelBox centers;
    MeasureItems(items_ + range.begin, range.count(), box, centers);
    const std::uint32_t count = range.count();
    if (count == 1) return range.begin;
    BuildItem* items = items_ + range.begin;
    const float area = box.HalfArea();
    const bool may_cut = count >= cuts_.minimum && range.room() > count / 16;
    ObjectSplit split;
    if (depth < kMaxSahDepth) {
      split = FindObjectSplit(
          items, count, centers,
          {.leaf_size = block, .overlap = may_cut, .one_axis = one_axis_});
    }
    if (count <= leaf_size_) {
      const bool is_cheaper =
          split.axis < 0 || split.cost + limit_.node_cost * area >= area;
      if (is_cheaper && (!limit_.fits || limit_.fits(items, count, block)))
        return range.begin;
    }
    if (may_cut && depth < kMaxSahDepth && split.overlap > kOverlap * area) {
      const SpatialSplit cut =
          FindSpatialSplit(items_, range, box, limit_.triangles, block);
      if (cut.cost < cuts_.Gain(count) * split.cost) {
        const std::uint32_t middle =
            CutAndPartition(items_, range, cut, limit_.triangles);
        if (middle != range.begin && middle != range.end) return middle;
      }
    }
    return range.begin + Partition(items, count, centers, split);
  }

  // Returns the area of the triangles; a cut one counts in proportion to its box.
  float SurfaceOf(ItemRange range) const {
    float area = 0;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const TriangleRecord& triangle = limit_.triangles[items_[i].id];
      const float whole = BoxOf(triangle).HalfArea();
      const float part = whole > 0 ? items_[i].box.HalfArea() / whole : 1.0f;
      area += std::min(part, 1.0f) * TriangleArea(triangle);
    }
    return area;
  }

  double AreaOf(ItemRange range) const {
    double area = 0;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      area += items_[i].box.HalfArea();
    }
    return area;
  }

  // Makes `range` the part before `middle` and returns the rest, with the room shared in
  // proportion to the areas: large boxes have most to gain from cuts.
  ItemRange DistributeRoom(ItemRange& range, std::uint32_t middle) {
    ItemRange second{middle, range.end, range.limit};
    range.end = range.limit = middle;
    if (second.room() == 0) return second;
    const double left = AreaOf(range), all = left + AreaOf(second);
    const double fraction = all > 0 && std::isfinite(all) ? left / all : 0.5;
    const auto room = static_cast<std::uint32_t>(fraction * second.room());
    std::memmove(static_cast<void*>(items_ + middle + room), items_ + middle,
                 second.count() * sizeof(BuildItem));
    range.limit += room;
    second.begin += room;
    second.end += room;
    return second;
  }

  BuildItem* items_;
  const LeafLimit& limit_;
  const CutPlan cuts_;
  std::uint32_t leaf_size_;
  bool one_axis_;
  BinaryTree tree_;
};

// Returns the ids of all items, leaf by leaf, and makes `leaves` refer to them.
std::vector<std::uint32_t> CollectIds(const std::vector<BuildItem>& items,
                                      std::vector<LeafRange>& leaves) {
  std::vector<std::uint32_t> ids;
  std::size_t count = 0;
  for (const LeafRange& leaf : leaves) count += leaf.end - leaf.begin;
  ids.reserve(count);
  for (LeafRange& leaf : leaves) {
    const auto begin = static_cast<std::uint32_t>(ids.size());
    for (std::uint32_t i = leaf.begin; i < leaf.end; ++i) ids.push_back(items[i].id);
    leaf.begin = begin;
    leaf.end = static_cast<std::uint32_t>(ids.size());
  }
  return ids;
}

}  // namespace

BuiltBvh BuildTree(std::vector<BuildItem> items, const LeafLimit& limit,
                   BuildQuality quality, AlignedVector<WideNode>& nodes) {
  BuiltBvh result;
  if (items.empty()) return result;
  const auto count = static_cast<std::uint32_t>(items.size());
  CutPlan cuts;
  const bool fast = quality == BuildQuality::kFast;
  if (limit.triangles != nullptr && !fast) cuts = PlanCuts(items, limit.triangles);
  // The two largest indices would be taken for kEmptyRef, and for a ray's way back.
  LL_CHECK_LT(items.size() + cuts.room, std::size_t{kRefIndex});
  items.resize(items.size() + cuts.room);
  TreeBuilder builder(items, limit, cuts, fast);
  builder.Build(0, {0, count, count + cuts.room}, 0, 0);
  BinaryTree& tree = builder.tree();
  if (!fast) ReinsertSubtrees(tree);
  result.bvh = Collapse(tree, items, limit.items == 0, nodes, result.leaves);
  result.ids = CollectIds(items, result.leaves);
  return result;
}

}  // namespace lanelight
