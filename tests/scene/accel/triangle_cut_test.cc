// Boxes of the two parts of a triangle: tight on cases done by hand, never too small on
// random ones.
#include "src/scene/accel/triangle_cut.h"

#include <catch2/catch.hpp>

#include <vector>

#include "tests/scene/accel/sticks.h"

namespace lanelight {
namespace {

using brute::Random;

AccelBox Whole(const TriangleRecord& triangle) {
  AccelBox box;
  for (int k = 0; k < 3; ++k) box.Extend(brute::Corner(triangle, k));
  return box;
}

void CheckNear(const AccelBox& box, Vec3f lo, Vec3f hi) {
  for (int a = 0; a < 3; ++a) {
    CAPTURE(a);
    CHECK(box.lo[a] == Approx(lo[a]).margin(1e-6));
    CHECK(box.hi[a] == Approx(hi[a]).margin(1e-6));
  }
}

}  // namespace

TEST_CASE("parts of a triangle have tight boxes", "[accel]") {
  const TriangleRecord t = MakeTriangle({0, 0, 0}, {2, 0, 1}, {0, 2, 0});
  CutBoxes cut = CutTriangle(t, Whole(t), 0, 0.5f);
  CheckNear(cut.left, {0, 0, 0}, {0.5f, 2, 0.25f});
  CheckNear(cut.right, {0.5f, 0, 0.25f}, {2, 1.5f, 1});
  // Parts that were cut away stay away.
  cut = CutTriangle(t, {{0, 0, 0}, {2, 1, 1}}, 0, 0.5f);
  CheckNear(cut.left, {0, 0, 0}, {0.5f, 1, 0.25f});
  CheckNear(cut.right, {0.5f, 0, 0.25f}, {2, 1, 1});
  // Through a corner, and where the box has nothing of the triangle beyond the plane.
  cut = CutTriangle(t, Whole(t), 1, 0.0f);
  CheckNear(cut.left, {0, 0, 0}, {2, 0, 1});
  CheckNear(cut.right, {0, 0, 0}, {2, 2, 1});
  cut = CutTriangle(t, {{0, 1.5f, 0}, {2, 2, 1}}, 0, 1.0f);
  CHECK_FALSE(IsEmpty(cut.left));
  CHECK(IsEmpty(cut.right));
}

TEST_CASE("sections of a triangle are its points on a plane", "[accel]") {
  const SortedTriangle t(MakeTriangle({2, 0, 1}, {0, 0, 0}, {1, 2, 0}), 0);
  CHECK(t.corner(1)[1] == 2);
  CheckNear(t.Section(0).Box(), {0, 0, 0}, {0, 0, 0});
  CheckNear(t.Section(0.5f).Box(), {0.5f, 0, 0}, {0.5f, 1, 0.25f});
  CheckNear(t.Section(1.5f).Box(), {1.5f, 0, 0.5f}, {1.5f, 1, 0.75f});
  CheckNear(t.Section(2).Box(), {2, 0, 1}, {2, 0, 1});
  CHECK(t.Section(2.5f).IsEmpty());
}

TEST_CASE("every point of a triangle is in the box of some part of it", "[accel]") {
  Random random(71);
  Geometry g = brute::Sticks(random, 300, 0.5f);
  const Geometry soup = brute::Soup(random, 300, 1, 0.5f);
  g.triangles.insert(g.triangles.end(), soup.triangles.begin(), soup.triangles.end());
  for (const TriangleRecord& t : g.triangles) {
    std::vector<AccelBox> parts = {Whole(t)};
    for (int k = 0; k < 8; ++k) {  // cut a part across its longest side
      const AccelBox box = parts[k / 2];
      const Vec3f e = box.hi - box.lo;
      const int axis = e.x > e.y ? (e.x > e.z ? 0 : 2) : (e.y > e.z ? 1 : 2);
      const float x = box.lo[axis] + random(0.2f, 0.8f) * e[axis];
      const CutBoxes cut = CutTriangle(t, box, axis, x);
      REQUIRE(cut.left.HalfArea() <= box.HalfArea());
      REQUIRE(cut.right.HalfArea() <= box.HalfArea());
      parts[k / 2] = cut.left;
      parts.push_back(cut.right);
    }
    for (int k = 0; k < 50; ++k) {
      const Vec3d p = brute::PointOn(t, random);
      bool covered = false;
      for (const AccelBox& box : parts) covered = covered || brute::Holds(box, p);
      REQUIRE(covered);
    }
  }
}

}  // namespace lanelight
