// Where the frame of a scene lies, and which spheres are compiled as large ones.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/scene/compile/focus.h"
#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

Shape SphereAt(Vec3d center, double radius) {
  Shape shape = SphereShape(radius, 0);
  shape.world_from_object = Transform::Translate(center);
  return shape;
}

SceneDescription SeenFrom(Vec3d eye, std::vector<Shape> shapes) {
  SceneDescription d;
  AddMaterial(d, OfKind(MaterialKind::kDiffuse));
  d.camera.world_from_camera = Transform::Translate(eye);
  d.shapes = std::move(shapes);
  return d;
}

// Distance of the frame's origin from p, in units of the scene file.
double Off(const CompiledScene& scene, Vec3d p) { return Length(scene.center - p); }

}  // namespace

TEST_CASE("focus: scenes of one size are compiled about their box", "[compile]") {
  const auto scene = CompileScene(
      SeenFrom({0, 0, 5}, {SphereAt({1, 0, 0}, 1), SphereAt({30, 10, 0}, 2)}));
  CHECK(scene.center == Vec3d{16, 5, 0} + Vec3d{0, 0.5, 0});
  CHECK(scene.geometry.spheres.size() == 2);
  CHECK(scene.geometry.large_spheres.empty());
  CHECK_FALSE(scene.features.Has(Feature::kLargeSpheres));
}

TEST_CASE("focus: the ground under the camera is a large sphere", "[compile]") {
  for (const double radius : {1e3, 1e6, 1e9, 1e12}) {
    CAPTURE(radius);
    const auto scene = CompileScene(
        SeenFrom({3, 0, 1}, {SphereAt({3, 0, -radius}, radius), SphereAt({5, 0, 1}, 1)}));
    CHECK(Off(scene, {3, 0, 0}) < 10);
    CHECK(scene.features.Has(Feature::kLargeSpheres));
    REQUIRE(scene.geometry.spheres.size() == 1);
    REQUIRE(scene.geometry.large_spheres.size() == 1);
    const LargeSphereRecord& s = scene.geometry.large_spheres[0];
    CHECK(s.normal[2] == 1);
    CHECK(s.curvature * radius * scene.scale == Approx(1));
    const double foot = s.point[2] / scene.scale + scene.center.z;
    CHECK(std::abs(foot) < 1e-6);
    // A ball of radius 1 still has digits.
    CHECK(scene.geometry.spheres[0].radius > 1e-9);
    const auto& ranges = scene.geometry.ranges;
    CHECK(ranges.large_spheres == 1);
    CHECK(ranges.end == 2);
  }
}

TEST_CASE("focus: the frame lies where the camera looks closely", "[compile]") {
  const double far = 1e7;
  const auto scene = CompileScene(
      SeenFrom({0, -6, 0}, {SphereAt({far, 0, 0}, 1), SphereAt({0, 0, 0}, 1)}));
  CHECK(Off(scene, {0, 0, 0}) < 1e-9);
  CHECK(scene.geometry.spheres.size() == 2);
}

TEST_CASE("focus: details of a large mesh", "[compile]") {
  // A square of side 2e6, and a corner of it moved to the camera's feet.
  TriangleMesh mesh = Square();
  for (Vec3d& p : mesh.positions) p = p * 1e6;
  mesh.positions.push_back({3e5, 2e5, 0});
  mesh.indices.insert(mesh.indices.end(), {0, 1, 4});
  const auto far = CompileScene(SeenFrom({1e5, 1e5, 5e4}, {MeshShape(mesh, 0)}));
  CHECK(Off(far, {0, 0, 0}) < 1e-6);
  const auto near = CompileScene(SeenFrom({3e5, 2e5, 1}, {MeshShape(mesh, 0)}));
  CHECK(Off(near, {3e5, 2e5, 0}) < 1e-6);
  // From the very vertex nothing is to be seen of it.
  const auto on = CompileScene(SeenFrom({3e5, 2e5, 0}, {MeshShape(mesh, 0)}));
  CHECK(Off(on, {0, 0, 0}) < 1e-6);
}

TEST_CASE("focus: emitting spheres, and those at a distance, are ordinary", "[compile]") {
  SceneDescription d = SeenFrom({0, 0, 1}, {SphereAt({0, 0, -1e6}, 1e6)});
  AreaLight light;
  light.radiance = {1, 1, 1};
  d.shapes[0].area_light = AddAreaLight(d, light);
  const auto scene = CompileScene(d);
  CHECK(scene.geometry.large_spheres.empty());
  REQUIRE(scene.notes.size() == 1);
  CHECK(scene.notes[0].message.find("is 1e+06 times the") != std::string::npos);

  d.shapes[0] = SphereAt({0, 0, -1e4}, 1e4);
  d.shapes[0].area_light = 0;
  CHECK(CompileScene(d).notes.empty());

  for (const double ratio : {kFocusRange * 0.99, kFocusRange * 1.01}) {
    const auto scene =
        CompileScene(SeenFrom({0, 0, 1}, {SphereAt({0, 0, -ratio}, ratio)}));
    CHECK(scene.geometry.large_spheres.size() == (ratio > kFocusRange ? 1u : 0u));
  }
}

TEST_CASE("focus: the foot point is the nearest point", "[compile]") {
  const NearestPoint above = NearestPointOn({0, 0, -100}, 100, {0, 0, 2});
  CHECK(above.distance == Approx(2));
  CHECK(Length(above.point) < 1e-12);
  const NearestPoint inside = NearestPointOn({0, 0, 0}, 10, {0, 7, 0});
  CHECK(inside.distance == Approx(3));
  CHECK(inside.point == Vec3d{0, 10, 0});
  CHECK(NearestPointOn({1, 1, 1}, 5, {1, 1, 1}).distance == 5);  // any point will do
}

}  // namespace lanelight
