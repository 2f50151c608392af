#include "src/scene/accel/binary_tree.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/scene/accel/shape_items.h"

namespace lanelight {
namespace {

// Relative costs of a wide node and of a leaf: cycles of a single ray, see
// docs/intersect.md.
constexpr float kWideNodeCost = 22, kLeafCost = 30;

constexpr std::uint32_t kSubtree = 8192;

// A part of the wide tree; references are relative to its own nodes and leaves.
struct Part {
  AlignedVector<WideNode> nodes;
  std::vector<LeafRange> leaves;
  std::uint32_t root = kEmptyRef;
  int depth = 0;
};

// A child of the top of the tree that is a part of its own.
struct Subtree {
  std::uint32_t at;    // in the binary tree
  std::uint32_t node;  // its parent in the top
  int child, depth;
};

class Collapser {
 public:
  // Subtrees are left out and listed in `rest`, if it is not null.
  Collapser(const BinaryTree& tree, const std::vector<BuildItem>& items, bool single,
            Part& part, std::vector<Subtree>* rest)
      : tree_(tree),
        items_(items),
        single_(single),
        nodes_(part.nodes),
        leaves_(part.leaves),
        depth_(part.depth),
        rest_(rest) {}

  std::uint32_t Emit(std::uint32_t at, int depth) {
    if (tree_[at].IsLeaf()) return EmitLeaf(tree_[at]);
    depth_ = std::max(depth_, depth);
    std::uint32_t child[kBvhWidth];
    int count = 0;
    Divide(at, kBvhWidth, child, count);
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    int slot[kBvhWidth];
    AssignSlots(tree_[at].box, child, count, slot);
    WideNode node = {};
    ChildOdds odds[kBvhWidth];
    for (int c = 0; c < kBvhWidth; ++c) {
      const int from = slot[c];
      const AccelBox box = from >= 0 ? tree_[child[from]].box : AccelBox();
      for (int a = 0; a < 3; ++a) {
        node.bounds[a][0][c] = box.lo[a];
        node.bounds[a][1][c] = box.hi[a];
      }
      node.child[c] = kEmptyRef;
      if (from < 0) continue;
      odds[c] = OddsOf(tree_[child[from]], tree_[at]);
      if (rest_ != nullptr && IsSubtree(child[from])) {
        rest_->push_back({child[from], index, c, depth + 1});
      } else {
        node.child[c] = Emit(child[from], depth + 1);
      }
    }
    SetBlockerOrder(odds, node);
    nodes_[index] = node;
    return index;
  }

 private:
  bool IsSubtree(std::uint32_t at) const {
    return !tree_[at].IsLeaf() && tree_[at].end - tree_[at].begin <= kSubtree;
  }

  std::uint32_t EmitLeaf(const BinaryNode& leaf) {
    if (single_) return kLeafBit | items_[leaf.begin].id;
    leaves_.push_back({leaf.begin, leaf.end, leaf.capacity});
    return kLeafBit | static_cast<std::uint32_t>(leaves_.size() - 1);
  }

  static ChildOdds OddsOf(const BinaryNode& child, const BinaryNode& parent) {
    const float half = child.box.HalfArea();
    if (!(half > 0)) return {};
    return {half / parent.box.HalfArea(), BlockingOdds(child.area, half),
            child.cost[0] / half};
  }

  // Lists the roots of the planned forest of `roots` trees below an inner node.
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

  // Assigns children to slots so that a ray with negative direction in the axes of
  // `octant` meets them about nearest first in the order 0 ^ octant, 1 ^ octant, ...: bit
  // a of a slot means that its child lies towards the upper end of axis a. The pair of
  // child and slot that gains most is fixed first (greedy form of Ylitie, Karras and
  // Laine 2017, section 3.2). slot[s] is the child of slot s, or -1.
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

  const BinaryTree& tree_;
  const std::vector<BuildItem>& items_;
  bool single_;
  AlignedVector<WideNode>& nodes_;
  std::vector<LeafRange>& leaves_;
  int& depth_;
  std::vector<Subtree>* rest_;
};

// The position of a part in the whole.
struct Place {
  std::size_t node = 0, leaf = 0;

  std::uint32_t Of(std::uint32_t ref, bool single) const {
    if (ref == kEmptyRef || (single && (ref & kLeafBit))) return ref;
    return ref + static_cast<std::uint32_t>(ref & kLeafBit ? leaf : node);
  }
};

void Append(const Part& part, bool single, const Place& place,
            AlignedVector<WideNode>& nodes, std::vector<LeafRange>& leaves) {
  for (std::size_t n = 0; n < part.nodes.size(); ++n) {
    WideNode& node = nodes[place.node + n] = part.nodes[n];
    for (std::uint32_t& child : node.child) child = place.Of(child, single);
  }
  std::ranges::copy(part.leaves, leaves.data() + place.leaf);
}

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
  n.area = tree[n.child].area + tree[n.child + 1].area;
  for (int roots = 2; roots <= kBvhWidth; ++roots) {
    float minimum = INFINITY;
    for (int k = 1; k < roots; ++k) {
      const float cost = a[k - 1] + b[roots - k - 1];
      // The first always, since costs of huge scenes overflow.
      if (k > 1 && !(cost < minimum)) continue;
      minimum = cost;
      n.left[roots - 1] = static_cast<std::uint8_t>(k);
    }
    n.cost[roots - 1] = minimum;
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
  std::vector<Subtree> subtrees;
  std::vector<Part> parts(1);  // the top, and the subtrees
  const bool divide = tree[0].end - tree[0].begin > kSubtree;
  parts[0].root =
      Collapser(tree, items, single, parts[0], divide ? &subtrees : nullptr).Emit(0, 1);
  parts.resize(1 + subtrees.size());
  ParallelFor(subtrees.size(), [&](std::size_t i) {
    Part& part = parts[i + 1];
    const Subtree& subtree = subtrees[i];
    part.root =
        Collapser(tree, items, single, part, nullptr).Emit(subtree.at, subtree.depth);
  });

  Bvh bvh;
  std::vector<Place> places(parts.size());
  Place end{nodes.size(), leaves.size()};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    places[i] = end;
    end.node += parts[i].nodes.size();
    end.leaf += parts[i].leaves.size();
    bvh.depth = std::max(bvh.depth, parts[i].depth);
    parts[i].root = places[i].Of(parts[i].root, single);
  }
  LL_CHECK_LT(end.node, std::size_t{kSeparateBit});
  LL_CHECK_LT(end.leaf, std::size_t{kSeparateBit});
  LL_CHECK_LT(bvh.depth * (kBvhWidth - 1) + 1, kTraversalStack);
  nodes.resize(end.node);
  leaves.resize(end.leaf);
  ParallelFor(parts.size(),
              [&](std::size_t i) { Append(parts[i], single, places[i], nodes, leaves); });
  for (std::size_t i = 0; i < subtrees.size(); ++i) {
    nodes[places[0].node + subtrees[i].node].child[subtrees[i].child] = parts[i + 1].root;
  }
  bvh.root = parts[0].root;
  bvh.reach = Reach(tree[0].box);
  return bvh;
}

}  // namespace lanelight
