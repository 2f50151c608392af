// The order of children for shadow rays (src/scene/accel/blocker_order.cc), against
// enumeration and random lines.
#include "src/scene/accel/binary_tree.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "src/scene/accel/shape_items.h"
#include "tests/support/brute_force.h"

namespace lanelight {
namespace {

using brute::Random;

std::uint32_t SlotAt(const WideNode& node, std::uint32_t octant, std::uint32_t k) {
  return k ^ (octant & node.shadow_octants) ^ node.shadow_first;
}

// Expected cost of the order for rays of an octant, by enumeration: every child is
// missed, entered and passed, or entered and blocks.
double CostOf(const WideNode& node, std::uint32_t octant, const ChildOdds (&odds)[8],
              std::uint32_t k = 0) {
  if (k == kBvhWidth) return 0;
  const ChildOdds& child = odds[SlotAt(node, octant, k)];
  const double rest = CostOf(node, octant, odds, k + 1);
  return (1 - child.entered) * rest +
         child.entered * (1 - child.blocks) * (child.cost + rest) +
         child.entered * child.blocks * child.cost;
}

double MeanCost(const WideNode& node, const ChildOdds (&odds)[8]) {
  double sum = 0;
  for (std::uint32_t octant = 0; octant < 8; ++octant) sum += CostOf(node, octant, odds);
  return sum / 8;
}

}  // namespace

TEST_CASE("shadow rays visit a likely blocker first", "[accel]") {
  for (std::uint32_t wall = 0; wall < 8; ++wall) {
    ChildOdds odds[8];
    for (ChildOdds& child : odds) child = {0.4f, 0.3f, 100};
    odds[wall] = {0.6f, 0.6f, 30};
    WideNode node;
    SetBlockerOrder(odds, node);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      CHECK(SlotAt(node, octant, 0) == wall);
    }
  }
}

TEST_CASE("shadow rays use ray order where children are alike", "[accel]") {
  ChildOdds odds[8];
  for (ChildOdds& child : odds) child = {0.4f, 0.3f, 100};
  odds[3] = {};
  WideNode node;
  const auto check = [&] {
    SetBlockerOrder(odds, node);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      CHECK(SlotAt(node, octant, 0) == octant);
    }
  };
  SECTION("all the same") { check(); }
  SECTION("nothing blocks") {
    for (ChildOdds& child : odds) child.blocks = 0;
    odds[5].cost = 1;
    check();
  }
  SECTION("no numbers") {
    for (ChildOdds& child : odds) child.entered = NAN;
    check();
  }
}

TEST_CASE("no other first slot costs less than the chosen order", "[accel]") {
  Random random(5);
  int fixed = 0;
  for (int i = 0; i < 500; ++i) {
    ChildOdds odds[8];
    for (ChildOdds& child : odds) {
      if (random(0, 1) < 0.2f) continue;
      child = {random(0, 1), random(0, 1) * random(0, 1), random(20, 200)};
    }
    WideNode chosen;
    SetBlockerOrder(odds, chosen);
    fixed += chosen.shadow_octants == 0;
    for (std::uint32_t first = 0; first < 8; ++first) {
      WideNode other;
      other.shadow_octants = 0;
      other.shadow_first = first;
      CHECK(MeanCost(chosen, odds) <= MeanCost(other, odds) * 1.0051);
    }
    WideNode along;
    along.shadow_octants = 7;
    along.shadow_first = 0;
    CHECK(MeanCost(chosen, odds) <= MeanCost(along, odds) * 1.0001);
  }
  CHECK(fixed > 400);
}

TEST_CASE("lines through a box are blocked in proportion to its surface", "[accel]") {
  Random random(6);
  const Geometry soup = brute::Soup(random, 100, 1, 0.9f);
  AccelBox box;
  float area = 0;
  for (const TriangleRecord& triangle : soup.triangles) {
    box.Extend(BoxOf(triangle));
    area += TriangleArea(triangle);
  }
  // Uniform lines: through points of a large disk across a uniform direction.
  const Vec3f middle = 0.5f * (box.lo + box.hi);
  const float radius = 0.5f * Length(box.hi - box.lo);
  int entered = 0, blocked = 0;
  double crossings = 0, squares = 0;
  while (entered < 20000) {
    const Vec3f d = random.Direction();
    const Vec3f side =
        Normalize(Cross(d, std::abs(d.x) < 0.5f ? Vec3f{1, 0, 0} : Vec3f{0, 1, 0}));
    const float angle = random(0, 6.2831853f), r = radius * std::sqrt(random(0, 1));
    const Vec3f o = middle + (r * std::cos(angle)) * side +
                    (r * std::sin(angle)) * Cross(d, side) - (2 * radius) * d;
    float enter = 0, leave = 1e9f;
    for (int a = 0; a < 3; ++a) {
      const float s = (box.lo[a] - o[a]) / d[a], t = (box.hi[a] - o[a]) / d[a];
      enter = std::max(enter, std::min(s, t));
      leave = std::min(leave, std::max(s, t));
    }
    if (!(enter <= leave)) continue;
    ++entered;
    int n = 0;
    for (const TriangleRecord& triangle : soup.triangles) {
      const auto hit = brute::Solve(triangle, brute::ToDouble(o), brute::ToDouble(d));
      n += hit && hit->inside >= 0;
    }
    blocked += n > 0;
    crossings += n;
    squares += n * n;
  }
  const double mean = crossings / entered,
               error = std::sqrt((squares / entered - mean * mean) / entered);
  const double expected = area / box.HalfArea();
  CAPTURE(mean, error, expected);
  CHECK(error < 0.02 * expected);
  CHECK(std::abs(mean - expected) < 4 * error);
  // At most so many are blocked: what lies in clumps blocks less (Jensen's inequality).
  const double odds = BlockingOdds(area, box.HalfArea());
  CHECK(odds == Approx(1 - std::exp(-expected)));
  CHECK(blocked < odds * entered);
  CHECK(blocked > 0.5 * odds * entered);
}

}  // namespace lanelight
