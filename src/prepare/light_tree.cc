#include "src/prepare/light_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/core/check.h"

namespace lanelight {
namespace {

constexpr int kBins = 12;
constexpr double kPi = std::numbers::pi;

struct Cone {
  Vec3d axis{0, 0, 1};
  double angle = -1;  // half angle; below 0: empty; pi: all directions
};

// Least cone around two cones (Conty Estevez and Kulla 2018, algorithm 1).
Cone Union(const Cone& a, const Cone& b) {
  if (a.angle < 0) return b;
  if (b.angle < 0) return a;
  const Cone& wide = a.angle >= b.angle ? a : b;
  const Cone& narrow = a.angle >= b.angle ? b : a;
  const double between = std::acos(std::clamp(Dot(wide.axis, narrow.axis), -1.0, 1.0));
  if (std::min(between + narrow.angle, kPi) <= wide.angle) return wide;
  const double angle = (wide.angle + between + narrow.angle) / 2;
  const Vec3d across = Cross(wide.axis, narrow.axis);
  if (angle >= kPi || !(Length(across) > 1e-12)) return {wide.axis, kPi};
  // Turn the wide axis towards the narrow one.
  const Vec3d side = Normalize(Cross(across, wide.axis));
  const double turn = angle - wide.angle;
  return {std::cos(turn) * wide.axis + std::sin(turn) * side, angle};
}

struct Bounds {
  Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  Cone cone;
  double power = 0;

  void Add(Vec3d p) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  void Add(const Bounds& o) {
    if (!(o.power > 0)) return;
    Add(o.low);
    Add(o.high);
    cone = Union(cone, o.cone);
    power += o.power;
  }
  Vec3d Center() const { return 0.5 * (low + high); }
  double Area() const {
    const Vec3d d = high - low;
    return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
  }
  // Solid angle into which the lights shine, weighted by the cosine beyond the cone.
  double Orientation() const {
    const double o = cone.angle, w = std::min(o + kPi / 2, kPi);
    return 2 * kPi * (1 - std::cos(o)) + kPi / 2 *
                                             (2 * w * std::sin(o) - std::cos(o - 2 * w) -
                                              2 * o * std::sin(o) + std::cos(o));
  }
  double Cost(double stretch) const {
    return power > 0 ? power * Orientation() * stretch * (Area() + 1e-300) : 0;
  }
};

struct Leaf {
  Bounds bounds;
  std::uint32_t light = 0;
};

Vec3d ToVec(const float* v) { return {v[0], v[1], v[2]}; }

Bounds BoundsOf(const Geometry& g, const LightRecord& light) {
  Bounds b;
  b.cone = {{0, 0, 1}, kPi};
  switch (static_cast<LightShape>(light.shape)) {
    case LightShape::kTriangle: {
      const TriangleRecord& t = g.triangles[light.primitive];
      for (const auto& p : t.p) b.Add(ToVec(p));
      const Vec3d n = Cross(ToVec(t.p[1]) - ToVec(t.p[0]), ToVec(t.p[2]) - ToVec(t.p[0]));
      if (!light.two_sided) b.cone = {Normalize(n), 0};
      break;
    }
    case LightShape::kRectangle: {
      for (const std::uint32_t prim : {light.primitive, light.second_primitive}) {
        for (const auto& p : g.triangles[prim].p) b.Add(ToVec(p));
      }
      const Vec3d n = Cross(ToVec(light.direction), ToVec(light.side));
      if (!light.two_sided) b.cone = {Normalize(n), 0};
      break;
    }
    case LightShape::kSphere: {
      const SphereRecord& s = g.spheres[light.primitive - g.ranges.spheres];
      const double r = s.radius;
      b.Add(ToVec(s.center) - Vec3d{r, r, r});
      b.Add(ToVec(s.center) + Vec3d{r, r, r});
      break;
    }
    case LightShape::kDisk: {
      const DiskRecord& d = g.disks[light.primitive - g.ranges.disks];
      const Vec3d n = ToVec(d.normal);
      Vec3d extent;
      for (int k = 0; k < 3; ++k) {
        extent[k] = d.radius * std::sqrt(std::max(0.0, 1 - n[k] * n[k]));
      }
      b.Add(ToVec(d.center) - extent);
      b.Add(ToVec(d.center) + extent);
      if (!light.two_sided) b.cone = {Normalize(n), 0};
      break;
    }
    case LightShape::kProjection:
    case LightShape::kSpot: {
      b.Add(ToVec(light.position));
      const double width =
          2 * std::asin(std::sqrt(std::clamp(light.versine_total / 2.0, 0.0, 1.0)));
      b.cone = {Normalize(ToVec(light.direction)), std::max(0.0, width - kPi / 2)};
      break;
    }
    default:
      b.Add(ToVec(light.position));
  }
  return b;
}

bool HasPlace(const LightRecord& light) {
  const auto shape = static_cast<LightShape>(light.shape);
  return shape != LightShape::kDistant && shape != LightShape::kInfiniteConstant &&
         shape != LightShape::kInfiniteImage && shape != LightShape::kPortal;
}

class Builder {
 public:
  Builder(std::vector<Leaf> leaves, LightTree& tree)
      : leaves_(std::move(leaves)), tree_(tree) {}

  void Build() {
    tree_.nodes.resize(1);
    Node(0, -1, 0, leaves_.size());
  }

 private:
  void Node(std::size_t at, std::int32_t parent, std::size_t begin, std::size_t end) {
    Bounds bounds;
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

  // Bounds are rounded outwards by the relative rounding of a float.
  static void Store(const Bounds& b, std::int32_t parent, LightNode& node) {
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

  std::size_t Split(const Bounds& bounds, std::size_t begin, std::size_t end) {
    Bounds centers;
    for (std::size_t i = begin; i < end; ++i) centers.Add(leaves_[i].bounds.Center());
    const Vec3d size = bounds.high - bounds.low;
    const double longest = std::max({size.x, size.y, size.z});
    double best = std::numeric_limits<double>::infinity();
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = centers.high[axis] - centers.low[axis];
      if (!(extent > 0)) continue;
      Bounds bins[kBins];
      for (std::size_t i = begin; i < end; ++i) {
        bins[Bin(leaves_[i], axis, centers)].Add(leaves_[i].bounds);
      }
      for (int b = 1; b < kBins; ++b) {
        Bounds left, right;
        for (int k = 0; k < kBins; ++k) (k < b ? left : right).Add(bins[k]);
        if (!(left.power > 0) || !(right.power > 0)) continue;
        const double stretch = longest / std::max(size[axis], 1e-300);
        const double cost = left.Cost(stretch) + right.Cost(stretch);
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
        [&](const Leaf& leaf) { return Bin(leaf, best_axis, centers) < best_bin; });
    return static_cast<std::size_t>(middle - leaves_.begin());
  }

  static int Bin(const Leaf& leaf, int axis, const Bounds& centers) {
    const double extent = centers.high[axis] - centers.low[axis];
    const double at = (leaf.bounds.Center()[axis] - centers.low[axis]) / extent;
    return std::clamp(static_cast<int>(at * kBins), 0, kBins - 1);
  }

  std::vector<Leaf> leaves_;
  LightTree& tree_;
};

}  // namespace

LightTree BuildLightTree(const Geometry& geometry, std::span<const LightRecord> lights,
                         std::span<const double> weights) {
  LL_CHECK_EQ(lights.size(), weights.size());
  LightTree tree;
  std::vector<Leaf> leaves;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    if (!HasPlace(lights[i])) {
      tree.far.push_back(i);
      continue;
    }
    Leaf leaf{BoundsOf(geometry, lights[i]), i};
    leaf.bounds.power = weights[i];
    leaves.push_back(leaf);
  }
  // The tree as a whole counts like one light without a place, as in pbrt-v4.
  const std::size_t choices = tree.far.size() + (leaves.empty() ? 0 : 1);
  tree.pmf_far = choices > 0 ? 1.0f / static_cast<float>(choices) : 0;
  tree.primitive_leaf.assign(geometry.ranges.end, -1);
  if (leaves.empty()) return tree;
  Builder(std::move(leaves), tree).Build();
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
