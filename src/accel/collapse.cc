#include "src/accel/collapse.h"

#include <algorithm>
#include <cmath>

#include "src/accel/grow.h"
#include "src/core/check.h"

namespace lanelight {
namespace {

// Relative costs of a wide node and of a leaf: cycles of a single ray, see
// docs/intersect.md.
constexpr float kWideNodeCost = 22, kLeafCost = 30;

class Collapser {
 public:
  Collapser(const BinaryTree& tree, const std::vector<BuildItem>& items, bool single,
            AlignedVector<WideNode>& nodes, std::vector<LeafRange>& leaves)
      : tree_(tree), items_(items), single_(single), nodes_(nodes), leaves_(leaves) {}

  std::uint32_t Emit(std::uint32_t at, int depth) {
    if (tree_[at].IsLeaf()) return EmitLeaf(tree_[at]);
    depth_ = std::max(depth_, depth);
    std::uint32_t child[kBvhWidth];
    int count = 0;
    Divide(at, kBvhWidth, child, count);
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    LL_CHECK_LT(index, kLeafBit);
    nodes_.emplace_back();
    int slot[kBvhWidth];
    AssignSlots(tree_[at].box, child, count, slot);
    WideNode node;
    for (int c = 0; c < kBvhWidth; ++c) {
      node.pad[c] = 0;
      const int from = slot[c];
      SetChild(node, c, from >= 0 ? tree_[child[from]].box : AccelBox());
      node.child[c] = from >= 0 ? Emit(child[from], depth + 1) : kEmptyRef;
    }
    nodes_[index] = node;
    return index;
  }

  int depth() const { return depth_; }

 private:
  std::uint32_t EmitLeaf(const BinaryNode& leaf) {
    if (single_) return kLeafBit | items_[leaf.begin].id;
    leaves_.push_back({leaf.begin, leaf.end, leaf.capacity});
    LL_CHECK_LT(leaves_.size(), kLeafBit - 1);
    return kLeafBit | static_cast<std::uint32_t>(leaves_.size() - 1);
  }

  // The planned forest of `roots` trees below an inner node.
  void Divide(std::uint32_t at, int roots, std::uint32_t child[kBvhWidth],
              int& count) const {
    const BinaryNode& n = tree_[at];
    const int left = n.left[roots - 1];
    Gather(n.child, left, child, count);
    Gather(n.child + 1, roots - left, child, count);
  }
  void Gather(std::uint32_t at, int roots, std::uint32_t child[kBvhWidth],
              int& count) const {
    const BinaryNode& n = tree_[at];
    while (roots > 1 && n.left[roots - 1] == 0) --roots;
    if (roots == 1) {
      child[count++] = at;
    } else {
      Divide(at, roots, child, count);
    }
  }

  // Slots such that a ray whose direction is negative in the axes given by the bits of
  // `octant` meets the children about nearest first in the order 0 ^ octant, 1 ^ octant,
  // ...: bit a of a slot says that its child lies towards the upper end of axis a. The
  // pair of child and slot that gains most is fixed first (a greedy form of Ylitie,
  // Karras and Laine 2017, section 3.2). slot[s] is the child of slot s, -1 if unused.
  void AssignSlots(const AccelBox& box, const std::uint32_t child[kBvhWidth], int count,
                   int slot[kBvhWidth]) const {
    float gain[kBvhWidth][kBvhWidth];
    const Vec3f middle = box.lo + box.hi;
    for (int c = 0; c < count; ++c) {
      const AccelBox& b = tree_[child[c]].box;
      const Vec3f v = b.lo + b.hi - middle;
      for (int s = 0; s < kBvhWidth; ++s) {
        gain[c][s] = (s & 1 ? v.x : -v.x) + (s & 2 ? v.y : -v.y) + (s & 4 ? v.z : -v.z);
      }
    }
    std::fill(slot, slot + kBvhWidth, -1);
    std::uint32_t open = (1u << count) - 1;
    while (open != 0) {
      int best_c = -1, best_s = -1;
      for (int c = 0; c < count; ++c) {
        if (!(open >> c & 1)) continue;
        for (int s = 0; s < kBvhWidth; ++s) {
          if (slot[s] >= 0) continue;
          if (best_c < 0 || gain[c][s] > gain[best_c][best_s]) best_c = c, best_s = s;
        }
      }
      slot[best_s] = best_c;
      open &= ~(1u << best_c);
    }
  }

  static void SetChild(WideNode& node, int c, const AccelBox& box) {
    for (int a = 0; a < 3; ++a) {
      node.bounds[a][0][c] = box.lo[a];
      node.bounds[a][1][c] = box.hi[a];
    }
  }

  const BinaryTree& tree_;
  const std::vector<BuildItem>& items_;
  bool single_;
  AlignedVector<WideNode>& nodes_;
  std::vector<LeafRange>& leaves_;
  int depth_ = 0;
};

}  // namespace

void PlanCollapse(BinaryTree& tree, std::uint32_t node) {
  BinaryNode& n = tree[node];
  std::fill_n(n.left, kBvhWidth, std::uint8_t{0});
  if (n.IsLeaf()) {
    std::fill_n(n.cost, kBvhWidth, kLeafCost * n.box.HalfArea());
    return;
  }
  const float* a = tree[n.child].cost;
  const float* b = tree[n.child + 1].cost;
  for (int roots = 2; roots <= kBvhWidth; ++roots) {
    float least = INFINITY;
    for (int k = 1; k < roots; ++k) {
      const float cost = a[k - 1] + b[roots - k - 1];
      // The first always, since costs of huge scenes overflow.
      if (k > 1 && !(cost < least)) continue;
      least = cost;
      n.left[roots - 1] = static_cast<std::uint8_t>(k);
    }
    n.cost[roots - 1] = least;
  }
  // Fewer trees than allowed are as good; left = 0 says so, except under a wide node.
  n.cost[0] = kWideNodeCost * n.box.HalfArea() + n.cost[kBvhWidth - 1];
  for (int i = 1; i < kBvhWidth; ++i) {
    if (n.cost[i - 1] > n.cost[i]) continue;
    n.cost[i] = n.cost[i - 1];
    if (i < kBvhWidth - 1) n.left[i] = 0;
  }
}

Bvh Collapse(const BinaryTree& tree, const std::vector<BuildItem>& items, bool single,
             AlignedVector<WideNode>& nodes, std::vector<LeafRange>& leaves) {
  Collapser collapser(tree, items, single, nodes, leaves);
  Bvh bvh;
  bvh.root = collapser.Emit(0, 1);
  bvh.depth = collapser.depth();
  bvh.reach = Reach(tree[0].box);
  LL_CHECK_LT(bvh.depth * (kBvhWidth - 1) + 1, kTraversalStack);
  return bvh;
}

}  // namespace lanelight
