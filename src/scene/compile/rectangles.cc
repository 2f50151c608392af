#include "src/scene/compile/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace lanelight {
namespace {

constexpr double kRounding = 0x1p-22;  // of the largest coordinate: four half ulp
constexpr double kMaxRounding = 1e-4, kMinTolerance = 2e-5;  // of the shorter side

using Point = std::array<float, 3>;
using Edge = std::array<Point, 2>;  // its ends in order, whichever way it is run through

Point PointOf(const float* p) { return {p[0], p[1], p[2]}; }

double Largest(const TriangleRecord& t) {
  double largest = 0;
  for (const auto& p : t.p) {
    for (float v : p) largest = std::max(largest, std::abs(double(v)));
  }
  return largest;
}

// Returns the allowed deviation of a corner.
double Tolerance(const TriangleRecord& t, double shorter) {
  const double rounding = std::min(kRounding * Largest(t), kMaxRounding * shorter);
  return std::max(rounding, kMinTolerance * shorter);
}

// The corner opposite the longest side, and the sides from there in winding order.
struct Half {
  int corner = 0;
  Vec3d x, y;
  double tolerance = 0;

  Vec3d Normal() const { return Cross(x, y); }
};

int CornerOfLongest(const TriangleRecord& t) {
  double longest = -1;
  int corner = 0;
  for (int k = 0; k < 3; ++k) {
    const double side = Length(ToVec(t.p[(k + 1) % 3]) - ToVec(t.p[(k + 2) % 3]));
    if (side > longest) longest = side, corner = k;
  }
  return corner;
}

std::optional<Half> RightAngled(const TriangleRecord& t) {
  const int k = CornerOfLongest(t);
  const Vec3d corner = ToVec(t.p[k]);
  Half half{k, ToVec(t.p[(k + 1) % 3]) - corner, ToVec(t.p[(k + 2) % 3]) - corner, 0};
  const double x = Length(half.x), y = Length(half.y);
  half.tolerance = Tolerance(t, std::min(x, y));
  if (!(std::abs(Dot(half.x, half.y)) <= half.tolerance * std::max(x, y))) return {};
  return half;
}

Edge Longest(const TriangleRecord& t, const Half& half) {
  Edge edge = {PointOf(t.p[(half.corner + 1) % 3]), PointOf(t.p[(half.corner + 2) % 3])};
  if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
  return edge;
}

// Makes the shorter side perpendicular to the longer one, which is more precise.
Rectangle Squared(std::uint32_t first, std::uint32_t second, Vec3d corner, Vec3d x,
                  Vec3d y) {
  const bool x_longer = Length(x) >= Length(y);
  Vec3d &longer = x_longer ? x : y, &shorter = x_longer ? y : x;
  shorter = shorter - longer * (Dot(shorter, longer) / Dot(longer, longer));
  return {first, second, corner, x, y};
}

class Finder {
 public:
  explicit Finder(std::span<const TriangleRecord> mesh) : mesh_(mesh) {}

  std::vector<Rectangle> Find() {
    for (std::uint32_t i = 0; i < mesh_.size(); ++i) {
      const std::optional<Half> half = RightAngled(mesh_[i]);
      if (half) Add(i, *half);
    }
    std::ranges::sort(
        found_, [](const Rectangle& a, const Rectangle& b) { return a.first < b.first; });
    return std::move(found_);
  }

 private:
  void Add(std::uint32_t i, const Half& half) {
    const auto [at, fresh] = open_.try_emplace(Longest(mesh_[i], half), Open{i, half});
    if (fresh || !Match(at->second, i, half)) return;
    const auto [first, other] = at->second;
    const TriangleRecord& t = mesh_[first];
    found_.push_back(Squared(first, i, ToVec(t.p[other.corner]), other.x, other.y));
    open_.erase(at);
  }

  struct Open {
    std::uint32_t index;
    Half half;
  };

  bool Match(const Open& open, std::uint32_t i, const Half& half) const {
    const Half& other = open.half;
    if (!(Dot(other.Normal(), half.Normal()) > 0)) return false;
    const Vec3d want = ToVec(mesh_[open.index].p[other.corner]) + other.x + other.y;
    return Length(ToVec(mesh_[i].p[half.corner]) - want) <=
           std::min(other.tolerance, half.tolerance);
  }

  std::span<const TriangleRecord> mesh_;
  std::map<Edge, Open> open_;  // halves that wait for another
  std::vector<Rectangle> found_;
};

}  // namespace

std::vector<Rectangle> FindRectangles(std::span<const TriangleRecord> mesh) {
  return Finder(mesh).Find();
}

}  // namespace lanelight
