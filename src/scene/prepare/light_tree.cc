#include "src/scene/prepare/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

constexpr int kBins = 12;

// Returns the cost of one side of a split; `stretch` penalises splits of short axes.
double Cost(const LightBounds& b, double stretch) {
  return b.power > 0 ? b.power * b.Orientation() * stretch * (b.Area() + 1e-300) : 0;
}

struct LightLeaf {
  LightBounds bounds;
  std::uint32_t light = 0;
};

class LightTreeBuilder {
 public:
  LightTreeBuilder(std::vector<LightLeaf> leaves, LightTree& tree)
      : leaves_(std::move(leaves)), tree_(tree) {}

  void Build() {
    tree_.nodes.resize(1);
    Node(0, -1, 0, leaves_.size());
  }

 private:
  void Node(std::size_t at, std::int32_t parent, std::size_t begin, std::size_t end) {
    LightBounds bounds;
    for (std::size_t i = begin; i < end; ++i) bounds.Add(leaves_[i].bounds);
    Store(bounds, parent, tree_.nodes[at]);
    if (end - begin == 1) {
      tree_.nodes[at].child = ~static_cast<std::int32_t>(leaves_[begin].light);
      return;
    }
    const std::size_t middle = Split(bounds, begin, end);
    const std::size_t child = tree_.nodes.size();
    tree_.nodes.resize(child + 2);
    tree_.nodes[at].child = static_cast<std::int32_t>(child);
    Node(child, static_cast<std::int32_t>(at), begin, middle);
    Node(child + 1, static_cast<std::int32_t>(at), middle, end);
  }

  // LightBounds are rounded outwards by the relative rounding of a float.
  static void Store(const LightBounds& b, std::int32_t parent, LightNode& node) {
    for (int k = 0; k < 3; ++k) {
      const double slack = 1e-6 * std::max(std::abs(b.low[k]), std::abs(b.high[k]));
      node.low[k] = static_cast<float>(b.low[k] - slack);
      node.high[k] = static_cast<float>(b.high[k] + slack);
      node.axis[k] = static_cast<float>(b.cone.axis[k]);
    }
    node.cos_axis = static_cast<float>(std::cos(b.cone.angle));
    node.power = static_cast<float>(b.power);
    node.parent = parent;
  }

  std::size_t Split(const LightBounds& bounds, std::size_t begin, std::size_t end) {
    LightBounds centers;
    for (std::size_t i = begin; i < end; ++i) centers.Add(leaves_[i].bounds.Center());
    const Vec3d size = bounds.high - bounds.low;
    const double longest = std::max({size.x, size.y, size.z});
    double best = std::numeric_limits<double>::infinity();
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = centers.high[axis] - centers.low[axis];
      if (!(extent > 0)) continue;
      LightBounds bins[kBins];
      for (std::size_t i = begin; i < end; ++i) {
        bins[Bin(leaves_[i], axis, centers)].Add(leaves_[i].bounds);
      }
      for (int b = 1; b < kBins; ++b) {
        LightBounds left, right;
        for (int k = 0; k < kBins; ++k) (k < b ? left : right).Add(bins[k]);
        if (!(left.power > 0) || !(right.power > 0)) continue;
        const double stretch = longest / std::max(size[axis], 1e-300);
        const double cost = Cost(left, stretch) + Cost(right, stretch);
        if (cost < best) {
          best = cost;
          best_axis = axis;
          best_bin = b;
        }
      }
    }
    if (best_axis < 0) return begin + (end - begin) / 2;  // all in one place
    const auto middle = std::partition(
        leaves_.begin() + begin, leaves_.begin() + end,
        [&](const LightLeaf& leaf) { return Bin(leaf, best_axis, centers) < best_bin; });
    return static_cast<std::size_t>(middle - leaves_.begin());
  }

  static int Bin(const LightLeaf& leaf, int axis, const LightBounds& centers) {
    const double extent = centers.high[axis] - centers.low[axis];
    const double at = (leaf.bounds.Center()[axis] - centers.low[axis]) / extent;
    return std::clamp(static_cast<int>(at * kBins), 0, kBins - 1);
  }

  std::vector<LightLeaf> leaves_;
  LightTree& tree_;
};

}  // namespace

LightTree BuildLightTree(const Geometry& geometry, std::span<const LightRecord> lights,
                         std::span<const double> weights) {
  LL_CHECK_EQ(lights.size(), weights.size());
  LightTree tree;
  std::vector<LightLeaf> leaves;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    if (!HasPlace(lights[i])) {
      tree.far.push_back(i);
      continue;
    }
    LightLeaf leaf{BoundsOf(geometry, lights[i]), i};
    leaf.bounds.power = weights[i];
    leaves.push_back(leaf);
  }
  // The tree as a whole counts like one light without a place, as in pbrt-v4.
  const std::size_t choices = tree.far.size() + (leaves.empty() ? 0 : 1);
  tree.pmf_far = choices > 0 ? 1.0f / static_cast<float>(choices) : 0;
  tree.primitive_leaf.assign(geometry.ranges.end, -1);
  if (leaves.empty()) return tree;
  LightTreeBuilder(std::move(leaves), tree).Build();
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (tree.nodes[i].child >= 0) continue;
    const LightRecord& light = lights[static_cast<std::uint32_t>(~tree.nodes[i].child)];
    const auto leaf = static_cast<std::int32_t>(i);
    if (light.primitive >= geometry.ranges.end) continue;
    tree.primitive_leaf[light.primitive] = leaf;
    if (light.shape == static_cast<std::uint32_t>(LightShape::kRectangle)) {
      tree.primitive_leaf[light.second_primitive] = leaf;
    }
  }
  return tree;
}

}  // namespace lanelight
