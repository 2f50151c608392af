#include "src/accel/builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "src/accel/collapse.h"
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
        tree_(items.size()) {}

  // Fills the subtree rooted at `node` over items [begin, end).
  void Build(std::uint32_t node, std::uint32_t begin, std::uint32_t end, int depth) {
    BinaryNode& n = tree_[node];
    n.begin = begin;
    n.end = end;
    const std::uint32_t middle = Divide(n, depth);
    if (middle != begin) {
      n.child = tree_.AddPair();
      const auto left = [&] { Build(n.child, begin, middle, depth + 1); };
      const auto right = [&] { Build(n.child + 1, middle, end, depth + 1); };
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
  std::uint32_t Divide(BinaryNode& n, int depth) {
    const std::uint32_t begin = n.begin, end = n.end, count = end - begin;
    AccelBox centers;
    Measure(begin, end, n.box, centers);
    if (count == 1) return begin;
    Split split;
    if (depth < kMaxSahDepth) {
      split = count < kFewItems ? FindSplit<kFewBins>(begin, end, centers)
                                : FindSplit<kBins>(begin, end, centers);
    }
    if (count <= leaf_size_) {
      const float area = n.box.HalfArea();
      const bool pays = split.axis < 0 || split.cost + kNodeCost * area >= area;
      if (pays && (!limit_.fits || limit_.fits(&items_[begin], count))) return begin;
    }
    return Partition(begin, end, centers, split);
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

}  // namespace

BuiltTree BuildTree(std::vector<BuildItem>& items, const LeafLimit& limit,
                    AlignedVector<WideNode>& nodes) {
  BuiltTree result;
  if (items.empty()) return result;
  LL_CHECK_LT(items.size(), std::size_t{1} << 30);
  TreeBuilder builder(items, limit);
  builder.Build(0, 0, static_cast<std::uint32_t>(items.size()), 0);
  result.bvh = Collapse(builder.tree(), items, limit.items == 0, nodes, result.leaves);
  return result;
}

}  // namespace lanelight
