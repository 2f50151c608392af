// Which pairs of triangles are one rectangle, and the one light that they become.
#include "src/scene/compile/lights.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "src/base/core/transform.h"
#include "src/scene/compile/compile.h"
#include "tests/scene/compile/testing.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

// The quad p, p + x, p + x + y, p + y as two triangles, moved by `m` and rounded. `start`
// turns the corners of each triangle on.
std::vector<TriangleRecord> Quad(Vec3d p, Vec3d x, Vec3d y, const Transform& m = {},
                                 int start = 0) {
  const Vec3d corners[4] = {p, p + x, p + x + y, p + y};
  const auto at = [&](int i) { return VecCast<float>(m.Point(corners[i])); };
  const auto triangle = [&](int a, int b, int c) {
    const int order[3] = {a, b, c};
    return MakeTriangle(at(order[start % 3]), at(order[(start + 1) % 3]),
                        at(order[(start + 2) % 3]));
  };
  return {triangle(0, 1, 2), triangle(0, 2, 3)};
}

void CheckIs(const Rectangle& r, const std::vector<TriangleRecord>& mesh) {
  CHECK(std::abs(Dot(r.x_side, r.y_side)) < 1e-12 * Length(r.x_side) * Length(r.y_side));
  const double shorter = std::min(Length(r.x_side), Length(r.y_side));
  for (const std::uint32_t i : {r.first, r.second}) {
    const TriangleRecord& t = mesh[i];
    const Vec3d n = Cross(ToVec(t.p[1]) - ToVec(t.p[0]), ToVec(t.p[2]) - ToVec(t.p[0]));
    CHECK(Dot(n, Cross(r.x_side, r.y_side)) > 0);
    // Every corner of the triangles is one of the rectangle.
    for (const auto& p : t.p) {
      double nearest = 1e9;
      for (int k = 0; k < 4; ++k) {
        const Vec3d corner =
            r.corner + r.x_side * double(k & 1) + r.y_side * double(k / 2);
        nearest = std::min(nearest, Length(ToVec(p) - corner));
      }
      CHECK(nearest < 2e-4 * shorter);
    }
  }
}

}  // namespace

TEST_CASE("rectangles: two halves are found, whichever corner comes first", "[compile]") {
  for (int start = 0; start < 3; ++start) {
    const auto mesh = Quad({1, 2, 3}, {2, 0, 0}, {0, 0, 0.5}, {}, start);
    const std::vector<Rectangle> found = FindRectangles(mesh);
    REQUIRE(found.size() == 1);
    CHECK(found[0].first == 0);
    CHECK(found[0].second == 1);
    CheckIs(found[0], mesh);
  }
  const std::vector<TriangleRecord> none;
  CHECK(FindRectangles(none).empty());
}

TEST_CASE("rectangles: rotated and distant ones are found despite rounding",
          "[compile]") {
  std::mt19937 random(3);
  const auto u = [&] { return double(random() % 100000) / 100000 - 0.5; };
  for (int i = 0; i < 200; ++i) {
    const double size = std::pow(10, -2.5 * (u() + 0.5));
    const Transform m = Transform::Translate({u(), u(), u()}) *
                        Transform::Rotate(360 * u(), {u(), u(), u() + 1});
    const auto mesh = Quad({0, 0, 0}, {size, 0, 0}, {0, size * (1.5 + u()), 0}, m, i % 3);
    const std::vector<Rectangle> found = FindRectangles(mesh);
    CAPTURE(i, size);
    REQUIRE(found.size() == 1);
    CheckIs(found[0], mesh);
  }
}

TEST_CASE("rectangles: other quads stay two triangles", "[compile]") {
  const auto count = [](std::vector<TriangleRecord> mesh) {
    return FindRectangles(mesh).size();
  };
  const Vec3d p = {0.1, 0.2, 0.3};
  CHECK(count(Quad(p, {1, 0, 0}, {0, 1, 0})) == 1);
  CHECK(count(Quad(p, {1, 0, 0}, {0.5, 1, 0})) == 0);   // a parallelogram
  CHECK(count(Quad(p, {1, 0, 0}, {1e-4, 1, 0})) == 0);  // nearly a rectangle
  auto mesh = Quad(p, {1, 0, 0}, {0, 1, 0});
  mesh[1].p[2][2] += 1e-4f;  // bent
  CHECK(count(mesh) == 0);
  mesh = Quad(p, {1, 0, 0}, {0, 1, 0});
  std::swap_ranges(mesh[1].p[0], mesh[1].p[0] + 3, mesh[1].p[1]);  // faces the other way
  CHECK(count(mesh) == 0);
  mesh = Quad(p, {1, 0, 0}, {0, 1, 0});
  mesh[1] = mesh[0];  // the same half twice
  CHECK(count(mesh) == 0);
  mesh = Quad(p, {1, 0, 0}, {0, 1, 0});
  mesh.push_back(mesh[1]);  // a half too many
  CHECK(count(mesh) == 1);
}

TEST_CASE("rectangles: every cell of a grid is found", "[compile]") {
  std::vector<TriangleRecord> mesh;
  for (int i = 0; i < 30; ++i) {
    const auto cell = Quad({0.1 * (i % 6), 0.3 * (i / 6), 1}, {0.1, 0, 0}, {0, 0.3, 0});
    mesh.insert(mesh.end(), cell.begin(), cell.end());
  }
  std::shuffle(mesh.begin(), mesh.end(), std::mt19937(7));
  const std::vector<Rectangle> found = FindRectangles(mesh);
  REQUIRE(found.size() == 30);
  std::vector<int> uses(60, 0);
  for (const Rectangle& r : found) {
    CheckIs(r, mesh);
    CHECK(r.first < r.second);
    ++uses[r.first], ++uses[r.second];
  }
  CHECK(std::count(uses.begin(), uses.end(), 1) == 60);
  CHECK(std::is_sorted(found.begin(), found.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; }));
}

TEST_CASE("compile: a square that emits is one light", "[scene][compile]") {
  SceneDescription d = SquareScene();
  AreaLight light;
  light.radiance = {1, 2, 3};
  light.scale = 10;
  d.shapes[0].area_light = AddAreaLight(d, light);
  d.shapes.insert(d.shapes.begin(), MeshShape(Square(), 0));  // does not emit
  d.shapes[0].world_from_object = Transform::Translate({0, 0, 0.5});
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.lights.lights.size() == 1);
  const LightRecord& r = scene.lights.lights[0];
  CHECK(r.shape == static_cast<std::uint32_t>(LightShape::kRectangle));
  CHECK(ToVec(r.radiance) == Vec3d{10, 20, 30});
  CHECK(r.area == Approx(4 * scene.scale * scene.scale));
  CHECK(r.primitive == 2);
  CHECK(r.second_primitive == 3);
  CHECK(r.size[0] == Approx(2 * scene.scale));
  CHECK(r.size[1] == Approx(2 * scene.scale));
  CHECK(r.environment == -1);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(scene.geometry.triangles[i].light == (i < 2 ? -1 : 0));
  }
  CHECK(scene.features.HasAll({Feature::kAreaLights, Feature::kRectangleLights,
                               Feature::kLights, Feature::kMis}));
  CHECK_FALSE(scene.features.HasAny({Feature::kTriangleLights, Feature::kManyLights}));
}

}  // namespace lanelight
