#include "src/accel/builder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/accel/collapse.h"
#include "src/accel/object_split.h"
#include "src/core/check.h"
#include "src/core/parallel.h"

namespace lanelight {
namespace {

// Ranges smaller than this are built by one thread.
constexpr std::uint32_t kSerial = 2048;
// Ranges of at most so many items are looked at for how many of them a leaf holds.
constexpr std::uint32_t kFewItems = 64;
// Below this depth ranges are halved instead, which bounds the depth of any tree.
constexpr int kMaxSahDepth = 40;
// Cost of one level of the binary tree relative to testing one leaf: a wide node holds
// about three levels.
constexpr float kNodeCost = 0.35f;

class TreeBuilder {
 public:
  TreeBuilder(std::vector<BuildItem>& items, const LeafLimit& limit)
      : items_(items),
        limit_(limit),
        leaf_size_(std::max(1u, limit.items)),
        tree_(items.size()) {}

  // Fills the subtree rooted at `node` over items [begin, end). `leaf`: items that a leaf
  // holds, 0 if that is not known yet.
  void Build(std::uint32_t node, std::uint32_t begin, std::uint32_t end,
             std::uint32_t leaf, int depth) {
    BinaryNode& n = tree_[node];
    n.begin = begin;
    n.end = end;
    if (leaf == 0 && end - begin <= kFewItems) {
      leaf = limit_.typical ? limit_.typical(&items_[begin], end - begin) : leaf_size_;
    }
    const std::uint32_t middle = Divide(n, leaf, depth);
    if (middle != begin) {
      n.child = tree_.AddPair();
      const auto left = [&] { Build(n.child, begin, middle, leaf, depth + 1); };
      const auto right = [&] { Build(n.child + 1, middle, end, leaf, depth + 1); };
      if (end - begin > kSerial) {
        ParallelInvoke(left, right);
      } else {
        left();
        right();
      }
    }
    PlanCollapse(tree_, node);
  }

  const BinaryTree& tree() const { return tree_; }

 private:
  // Measures the box of `n` and sorts its items to two sides; returns where the second
  // begins, or n.begin if the items make a leaf.
  std::uint32_t Divide(BinaryNode& n, std::uint32_t leaf, int depth) {
    const std::uint32_t begin = n.begin, end = n.end, count = end - begin;
    AccelBox centers;
    Measure(begin, end, n.box, centers);
    if (count == 1) return begin;
    BuildItem* items = &items_[begin];
    ObjectSplit split;
    if (depth < kMaxSahDepth) {
      split = FindObjectSplit(items, count, centers, leaf == 0 ? leaf_size_ : leaf);
    }
    if (count <= leaf_size_) {
      const float area = n.box.HalfArea();
      const bool pays = split.axis < 0 || split.cost + kNodeCost * area >= area;
      if (pays && (!limit_.fits || limit_.fits(items, count))) return begin;
    }
    return begin + Partition(items, count, centers, split);
  }

  void Measure(std::uint32_t begin, std::uint32_t end, AccelBox& box,
               AccelBox& centers) const {
    WideBox all, middles;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Float4 lo = LowOf(items_[i]), hi = HighOf(items_[i]);
      all.Extend(lo, hi);
      middles.Extend(lo + hi, lo + hi);
    }
    box = all.Box();
    centers = middles.Box();
  }

  std::vector<BuildItem>& items_;
  const LeafLimit& limit_;
  std::uint32_t leaf_size_;
  BinaryTree tree_;
};

}  // namespace

BuiltTree BuildTree(std::vector<BuildItem>& items, const LeafLimit& limit,
                    AlignedVector<WideNode>& nodes) {
  BuiltTree result;
  if (items.empty()) return result;
  LL_CHECK_LT(items.size(), std::size_t{1} << 30);
  TreeBuilder builder(items, limit);
  builder.Build(0, 0, static_cast<std::uint32_t>(items.size()), 0, 0);
  result.bvh = Collapse(builder.tree(), items, limit.items == 0, nodes, result.leaves);
  return result;
}

}  // namespace lanelight
