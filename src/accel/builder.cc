#include "src/accel/builder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/check.h"
#include "src/core/parallel.h"

namespace lanelight {
namespace {

constexpr int kBins = 32;
// Ranges smaller than this are built by one thread.
constexpr std::uint32_t kSerial = 2048;
// Below this depth ranges are halved instead, which bounds the depth of any tree.
constexpr int kMaxSahDepth = 40;
// Cost of one level of the binary tree relative to testing one leaf: a wide node holds
// about three levels.
constexpr float kNodeCost = 0.35f;

struct BinaryNode {
  AccelBox box;
  std::uint32_t begin = 0, end = 0;
  std::uint32_t right = 0;  // second child; the first is the next node; 0 = leaf
  bool IsLeaf() const { return right == 0; }
};

struct Bin {
  AccelBox box;
  std::uint32_t count = 0;
};
using Bins = std::array<std::array<Bin, kBins>, 3>;

struct Split {
  int axis = -1;  // -1: halve
  int bin = 0;    // items of bins < bin go left
  float cost = INFINITY;
};

// Where an item falls: bin = (center2 - lo) * scale. Monotonic in the centre.
struct Binning {
  Vec3f lo, scale;

  explicit Binning(const AccelBox& centers) : lo(centers.lo) {
    const Vec3f extent = centers.hi - centers.lo;
    for (int a = 0; a < 3; ++a) {
      const float s = kBins / extent[a];
      scale[a] = extent[a] > 0 && std::isfinite(s) ? s : 0;
    }
  }
  int Of(Vec3f center2, int axis) const {
    return std::clamp(static_cast<int>((center2[axis] - lo[axis]) * scale[axis]), 0,
                      kBins - 1);
  }
};

class TreeBuilder {
 public:
  TreeBuilder(std::vector<BuildItem>& items, const LeafLimit& limit)
      : items_(items),
        limit_(limit),
        leaf_size_(std::max(1u, limit.items)),
        tree_(2 * items.size()) {}

  // Fills the subtree rooted at `node` over items [begin, end). A subtree of n items has
  // at most 2n - 1 nodes, so the second child's place is known before the first is built.
  void Build(std::uint32_t node, std::uint32_t begin, std::uint32_t end, int depth) {
    BinaryNode& n = tree_[node];
    n.begin = begin;
    n.end = end;
    AccelBox centers;
    Measure(begin, end, n.box, centers);
    const std::uint32_t count = end - begin;
    if (count == 1) return;
    Split split;
    if (depth < kMaxSahDepth) split = FindSplit(begin, end, centers);
    if (count <= leaf_size_) {
      const float area = n.box.HalfArea();
      const bool pays = split.axis < 0 || split.cost + kNodeCost * area >= area;
      if (pays && (!limit_.fits || limit_.fits(&items_[begin], count))) return;
    }
    const std::uint32_t middle = Partition(begin, end, centers, split);
    n.right = node + 2 * (middle - begin);
    const auto left = [&] { Build(node + 1, begin, middle, depth + 1); };
    const auto right = [&] { Build(n.right, middle, end, depth + 1); };
    if (count > kSerial) {
      ParallelInvoke(left, right);
    } else {
      left();
      right();
    }
  }

  const std::vector<BinaryNode>& tree() const { return tree_; }

 private:
  void Measure(std::uint32_t begin, std::uint32_t end, AccelBox& box,
               AccelBox& centers) const {
    for (std::uint32_t i = begin; i < end; ++i) {
      box.Extend(items_[i].box);
      centers.Extend(items_[i].Center2());
    }
  }

  float Blocks(std::uint32_t n) const {
    return static_cast<float>((n + leaf_size_ - 1) / leaf_size_);
  }

  Split FindSplit(std::uint32_t begin, std::uint32_t end, const AccelBox& centers) const {
    const Binning binning(centers);
    Bins bins;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Vec3f c = items_[i].Center2();
      for (int a = 0; a < 3; ++a) {
        Bin& bin = bins[a][binning.Of(c, a)];
        bin.box.Extend(items_[i].box);
        ++bin.count;
      }
    }
    Split best;
    for (int a = 0; a < 3; ++a) {
      if (binning.scale[a] > 0) Sweep(bins[a], a, best);
    }
    return best;
  }

  // Least sum of half area times blocks over the splits between bins of one axis.
  void Sweep(const std::array<Bin, kBins>& bins, int axis, Split& best) const {
    std::array<float, kBins> right_cost;
    AccelBox box;
    std::uint32_t count = 0;
    for (int b = kBins - 1; b > 0; --b) {
      box.Extend(bins[b].box);
      count += bins[b].count;
      right_cost[b] = count == 0 ? INFINITY : box.HalfArea() * Blocks(count);
    }
    box = AccelBox();
    count = 0;
    for (int b = 1; b < kBins; ++b) {
      box.Extend(bins[b - 1].box);
      count += bins[b - 1].count;
      if (count == 0) continue;
      const float cost = box.HalfArea() * Blocks(count) + right_cost[b];
      if (cost < best.cost) best = {axis, b, cost};
    }
  }

  std::uint32_t Partition(std::uint32_t begin, std::uint32_t end, const AccelBox& centers,
                          const Split& split) {
    if (split.axis < 0) return begin + (end - begin) / 2;
    const Binning binning(centers);
    const auto middle = std::partition(
        items_.begin() + begin, items_.begin() + end, [&](const BuildItem& item) {
          return binning.Of(item.Center2(), split.axis) < split.bin;
        });
    return static_cast<std::uint32_t>(middle - items_.begin());
  }

  std::vector<BuildItem>& items_;
  const LeafLimit& limit_;
  std::uint32_t leaf_size_;
  std::vector<BinaryNode> tree_;
};

// Turns a binary tree into wide nodes: children are opened, the largest first, until
// there are eight.
class Collapser {
 public:
  Collapser(const std::vector<BinaryNode>& tree, const std::vector<BuildItem>& items,
            bool single, AlignedVector<WideNode>& nodes, std::vector<LeafRange>& leaves)
      : tree_(tree), items_(items), single_(single), nodes_(nodes), leaves_(leaves) {}

  std::uint32_t Emit(std::uint32_t at, int depth) {
    if (tree_[at].IsLeaf()) return EmitLeaf(tree_[at]);
    depth_ = std::max(depth_, depth);
    std::uint32_t child[kBvhWidth];
    const int count = Open(at, child);
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
    leaves_.push_back({leaf.begin, leaf.end});
    LL_CHECK_LT(leaves_.size(), kLeafBit - 1);
    return kLeafBit | static_cast<std::uint32_t>(leaves_.size() - 1);
  }

  int Open(std::uint32_t at, std::uint32_t child[kBvhWidth]) const {
    int count = 2;
    child[0] = at + 1;
    child[1] = tree_[at].right;
    while (count < kBvhWidth) {
      int widest = -1;
      float area = -1;
      for (int c = 0; c < count; ++c) {
        const BinaryNode& n = tree_[child[c]];
        if (!n.IsLeaf() && n.box.HalfArea() > area) {
          widest = c;
          area = n.box.HalfArea();
        }
      }
      if (widest < 0) break;
      const std::uint32_t opened = child[widest];
      child[widest] = opened + 1;
      child[count++] = tree_[opened].right;
    }
    return count;
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

  const std::vector<BinaryNode>& tree_;
  const std::vector<BuildItem>& items_;
  bool single_;
  AlignedVector<WideNode>& nodes_;
  std::vector<LeafRange>& leaves_;
  int depth_ = 0;
};

float Reach(const AccelBox& box) {
  float reach = 0;
  for (int a = 0; a < 3; ++a) {
    reach = std::max({reach, std::abs(box.lo[a]), std::abs(box.hi[a])});
  }
  return reach;
}

}  // namespace

BuiltTree BuildTree(std::vector<BuildItem>& items, const LeafLimit& limit,
                    AlignedVector<WideNode>& nodes) {
  BuiltTree result;
  if (items.empty()) return result;
  LL_CHECK_LT(items.size(), std::size_t{1} << 30);
  TreeBuilder builder(items, limit);
  builder.Build(0, 0, static_cast<std::uint32_t>(items.size()), 0);
  Collapser collapser(builder.tree(), items, limit.items == 0, nodes, result.leaves);
  result.bvh.root = collapser.Emit(0, 1);
  result.bvh.depth = collapser.depth();
  result.bvh.reach = Reach(builder.tree()[0].box);
  LL_CHECK_LT(result.bvh.depth * (kBvhWidth - 1) + 1, kTraversalStack);
  return result;
}

}  // namespace lanelight
