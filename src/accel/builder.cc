#include "src/accel/builder.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>

#include "src/core/check.h"
#include "src/core/parallel.h"

namespace lanelight {
namespace {

// Bins per axis for many items, and for few, where sweeping bins costs more than it
// gains.
constexpr int kBins = 32, kFewBins = 12;
constexpr std::uint32_t kFewItems = 64;
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
  std::uint32_t child = 0;  // the first of two in a row; 0 = leaf
  bool IsLeaf() const { return child == 0; }
};

// The nodes of a binary tree, added in pairs by any thread. They stay where they are:
// chunks are added as they are needed, since most trees need far fewer nodes than the 2n
// that they may have.
class BinaryTree {
 public:
  explicit BinaryTree(std::size_t items)
      : chunks_(2 * items / kChunk + 2), next_(2) {}  // the root, and an unused one
  std::uint32_t AddPair() {
    const std::uint32_t at = next_.fetch_add(2, std::memory_order_relaxed);
    Touch(at / kChunk);
    return at;
  }
  void Touch(std::size_t chunk) {
    std::call_once(chunks_[chunk].made, [&] {
      chunks_[chunk].nodes = std::make_unique<BinaryNode[]>(kChunk);
    });
  }
  BinaryNode& operator[](std::uint32_t i) {
    return chunks_[i / kChunk].nodes[i % kChunk];
  }
  const BinaryNode& operator[](std::uint32_t i) const {
    return chunks_[i / kChunk].nodes[i % kChunk];
  }

 private:
  static constexpr std::uint32_t kChunk = 4096;
  struct Chunk {
    std::once_flag made;
    std::unique_ptr<BinaryNode[]> nodes;
  };
  std::vector<Chunk> chunks_;
  std::atomic<std::uint32_t> next_;
};

// Four numbers as one vector of the baseline target, the fourth unused.
typedef float Float4 __attribute__((vector_size(16)));

Float4 Least(Float4 a, Float4 b) { return a < b ? a : b; }
Float4 Largest(Float4 a, Float4 b) { return a > b ? a : b; }
Float4 Load4(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}
// The box of an item: its floats lie one after another, and the id behind them.
static_assert(offsetof(AccelBox, hi) == 12 && offsetof(BuildItem, id) == 24);
Float4 LowOf(const BuildItem& item) { return Load4(&item.box.lo.x); }
Float4 HighOf(const BuildItem& item) { return Load4(&item.box.hi.x); }

// A box as it grows.
struct WideBox {
  Float4 lo{INFINITY, INFINITY, INFINITY, INFINITY};
  Float4 hi{-INFINITY, -INFINITY, -INFINITY, -INFINITY};

  void Extend(Float4 l, Float4 h) {
    lo = Least(lo, l);
    hi = Largest(hi, h);
  }
  void Extend(const WideBox& b) { Extend(b.lo, b.hi); }
  float HalfArea() const {
    const Float4 e = hi - lo;
    return e[0] >= 0 ? e[0] * e[1] + e[1] * e[2] + e[2] * e[0] : 0.0f;
  }
  AccelBox Box() const { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }
};

struct Bin {
  WideBox box;
  std::uint32_t count = 0;
};

struct Split {
  int axis = -1;  // -1: halve
  int bin = 0;    // items of bins < bin go left
  float cost = INFINITY;
};

// Where an item falls: bin = (center2 - lo) * scale. Monotonic in the centre.
struct Binning {
  Vec3f lo, scale;

  int bins;

  Binning(const AccelBox& centers, std::uint32_t count)
      : lo(centers.lo), bins(count < kFewItems ? kFewBins : kBins) {
    const Vec3f extent = centers.hi - centers.lo;
    for (int a = 0; a < 3; ++a) {
      const float s = static_cast<float>(bins) / extent[a];
      scale[a] = extent[a] > 0 && std::isfinite(s) ? s : 0;
    }
  }
  int Of(Vec3f center2, int axis) const {
    return std::clamp(static_cast<int>((center2[axis] - lo[axis]) * scale[axis]), 0,
                      bins - 1);
  }
};

class TreeBuilder {
 public:
  TreeBuilder(std::vector<BuildItem>& items, const LeafLimit& limit)
      : items_(items),
        limit_(limit),
        leaf_size_(std::max(1u, limit.items)),
        tree_(items.size()) {
    tree_.Touch(0);
  }

  // Fills the subtree rooted at `node` over items [begin, end).
  void Build(std::uint32_t node, std::uint32_t begin, std::uint32_t end, int depth) {
    BinaryNode& n = tree_[node];
    n.begin = begin;
    n.end = end;
    AccelBox centers;
    Measure(begin, end, n.box, centers);
    const std::uint32_t count = end - begin;
    if (count == 1) return;
    Split split;
    if (depth < kMaxSahDepth) {
      split = count < kFewItems ? FindSplit<kFewBins>(begin, end, centers)
                                : FindSplit<kBins>(begin, end, centers);
    }
    if (count <= leaf_size_) {
      const float area = n.box.HalfArea();
      const bool pays = split.axis < 0 || split.cost + kNodeCost * area >= area;
      if (pays && (!limit_.fits || limit_.fits(&items_[begin], count))) return;
    }
    const std::uint32_t middle = Partition(begin, end, centers, split);
    n.child = tree_.AddPair();
    const auto left = [&] { Build(n.child, begin, middle, depth + 1); };
    const auto right = [&] { Build(n.child + 1, middle, end, depth + 1); };
    if (count > kSerial) {
      ParallelInvoke(left, right);
    } else {
      left();
      right();
    }
  }

  const BinaryTree& tree() const { return tree_; }

 private:
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

  float Blocks(std::uint32_t n) const {
    return static_cast<float>((n + leaf_size_ - 1) / leaf_size_);
  }

  template <int kCount>
  Split FindSplit(std::uint32_t begin, std::uint32_t end, const AccelBox& centers) const {
    const Binning binning(centers, end - begin);
    std::array<std::array<Bin, kCount>, 3> bins;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Vec3f c = items_[i].Center2();
      const Float4 lo = LowOf(items_[i]), hi = HighOf(items_[i]);
      for (int a = 0; a < 3; ++a) {
        Bin& bin = bins[a][binning.Of(c, a)];
        bin.box.Extend(lo, hi);
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
  template <std::size_t kCount>
  void Sweep(const std::array<Bin, kCount>& bins, int axis, Split& best) const {
    std::array<float, kCount> right_cost;
    WideBox box;
    std::uint32_t count = 0;
    for (std::size_t b = kCount - 1; b > 0; --b) {
      box.Extend(bins[b].box);
      count += bins[b].count;
      right_cost[b] = count == 0 ? INFINITY : box.HalfArea() * Blocks(count);
    }
    box = WideBox();
    count = 0;
    for (std::size_t b = 1; b < kCount; ++b) {
      box.Extend(bins[b - 1].box);
      count += bins[b - 1].count;
      if (count == 0) continue;
      const float cost = box.HalfArea() * Blocks(count) + right_cost[b];
      if (cost < best.cost) best = {axis, static_cast<int>(b), cost};
    }
  }

  std::uint32_t Partition(std::uint32_t begin, std::uint32_t end, const AccelBox& centers,
                          const Split& split) {
    if (split.axis < 0) return begin + (end - begin) / 2;
    const Binning binning(centers, end - begin);
    const auto middle = std::partition(
        items_.begin() + begin, items_.begin() + end, [&](const BuildItem& item) {
          return binning.Of(item.Center2(), split.axis) < split.bin;
        });
    return static_cast<std::uint32_t>(middle - items_.begin());
  }

  std::vector<BuildItem>& items_;
  const LeafLimit& limit_;
  std::uint32_t leaf_size_;
  BinaryTree tree_;
};

// Turns a binary tree into wide nodes: children are opened, the largest first, until
// there are eight.
class Collapser {
 public:
  Collapser(const BinaryTree& tree, const std::vector<BuildItem>& items, bool single,
            AlignedVector<WideNode>& nodes, std::vector<LeafRange>& leaves)
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
    child[0] = tree_[at].child;
    child[1] = child[0] + 1;
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
      child[widest] = tree_[opened].child;
      child[count++] = child[widest] + 1;
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

  const BinaryTree& tree_;
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
