// Intersection and surface description of the reference.
#include "tests/reference/geometry.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/reference/camera.h"
#include "tests/reference/scenes.h"

namespace lanelight::reference {
namespace {

bool Near(Vec3d a, Vec3d b, double tolerance = 1e-12) {
  return Length(a - b) < tolerance;
}

}  // namespace

TEST_CASE("reference: every shape is hit where it should be", "[reference]") {
  test::SceneBuilder b(1, 1);
  const Index m = b.AddDiffuse(test::Grey(0.5));
  b.AddSphere({0, 0, 10}, 1, m);
  b.AddDisk({5, 0, 10}, {0, 0, -1}, 1, m);
  b.AddPlane({0, 0, 20}, {0, 0, -1}, m);
  b.AddQuad({-6, -1, 10}, {2, 0, 0}, {0, 2, 0}, m);
  const Geometry geometry(b.Build(), nullptr);
  Random random(1);
  struct Case {
    double x, y, t;
    Vec3d normal;
  };
  for (const Case& c : {Case{0, 0, 9, {0, 0, -1}}, Case{0.6, 0, 9.2, {0.6, 0, -0.8}},
                        Case{5.3, 0.4, 10, {0, 0, -1}}, Case{5.9, 0.9, 20, {0, 0, -1}},
                        Case{-5.5, 0.5, 10, {0, 0, 1}}, Case{-4.1, -0.9, 10, {0, 0, 1}},
                        Case{-3.9, 0, 20, {0, 0, -1}}}) {
    const Ray ray = {{c.x, c.y, 0}, {0, 0, 1}};
    const Hit hit = geometry.Intersect(ray, kInfinity, random);
    INFO(c.x << ", " << c.y);
    REQUIRE(hit.primitive != kNone);
    CHECK(hit.t == Approx(c.t));
    const SurfacePoint at = geometry.Describe(ray, hit);
    CHECK(Near(at.p, {c.x, c.y, c.t}));
    CHECK(Near(at.ng, c.normal));
  }
  const Ray ahead = {{0, 0, 0}, {0, 0, 1}};
  CHECK(geometry.Intersect(ahead, 9.1, random).primitive != kNone);
  CHECK(geometry.Intersect(ahead, 8.9, random).primitive == kNone);
}

TEST_CASE("reference: a ray does not hit its origin again", "[reference]") {
  test::SceneBuilder b(1, 1);
  const Index m = b.AddDiffuse(test::Grey(0.5));
  b.AddSphere({1e6, 0, 0}, 1e-3, m);
  const Geometry geometry(b.Build(), nullptr);
  Random random(1);
  const Vec3d n = Normalize(Vec3d{1, 2, -2});
  const Vec3d p = Vec3d{1e6, 0, 0} + 1e-3 * n;
  CHECK(geometry.Intersect({p, n, 0}, kInfinity, random).primitive == kNone);
  const Hit through = geometry.Intersect({p, -n, 0}, kInfinity, random);
  CHECK(through.t == Approx(2e-3).epsilon(1e-6));
}

TEST_CASE("reference: transforms, mirroring and reversal of normals", "[reference]") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  Random random(1);
  const Ray down = {{0.2, 0.2, 5}, {0, 0, -1}};
  for (const bool mirrored : {false, true}) {
    for (const bool reversed : {false, true}) {
      for (const bool with_normals : {false, true}) {
        test::SceneBuilder b(1, 1);
        const Index m = b.AddDiffuse(test::Grey(0.5));
        mesh.normals.assign(with_normals ? 3 : 0, Vec3d{0, 0, 1});
        Shape& shape = b.AddMesh(mesh, m);
        shape.reverse_orientation = reversed;
        // Mirroring y: the object-space normal +z stays +z.
        if (mirrored)
          shape.world_from_object =
              Transform::Translate({0, 0.5, 0}) * Transform::Scale({1, -1, 1});
        const Geometry geometry(b.Build(), nullptr);
        const Hit hit = geometry.Intersect(down, kInfinity, random);
        REQUIRE(hit.primitive == 0);
        const SurfacePoint at = geometry.Describe(down, hit);
        INFO(mirrored << reversed << with_normals);
        CHECK(at.ng.z == (reversed ? -1 : 1));
        CHECK(at.ns.z == at.ng.z);
      }
    }
  }
}

TEST_CASE("reference: instances are placed and scaled", "[reference]") {
  test::SceneBuilder b(1, 1);
  const Index m = b.AddDiffuse(test::Grey(0.5));
  b.AddSphere({1, 0, 0}, 0.5, m);
  SceneDescription scene = b.Build();
  scene.objects.push_back({"ball", scene.shapes});
  scene.shapes.clear();
  Instance instance;
  instance.object = 0;
  instance.world_from_object =
      Transform::Translate({0, 0, 10}) * Transform::Scale({2, 2, 4});
  scene.instances.push_back(instance);
  const Geometry geometry(scene, nullptr);
  Random random(1);
  const Hit hit = geometry.Intersect({{2, 0, 0}, {0, 0, 1}}, kInfinity, random);
  CHECK(hit.t == Approx(8));  // the pole of an ellipsoid of half height 2 at z = 10
  CHECK(geometry.Intersect({{0.9, 0, 0}, {0, 0, 1}}, kInfinity, random).primitive ==
        kNone);
}

TEST_CASE("reference: camera rays meet the film where pbrt puts it", "[reference]") {
  test::SceneBuilder b(20, 10);
  b.Perspective({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 90);
  Random random(1);
  const SceneDescription& scene = b.Build();
  // Upper left corner: aspect 2, so x = -2, y = 1 at z = 1 (x to the right of the image).
  CHECK(Near(CameraRay(scene.camera, scene.film, 0, 0, random).d,
             Normalize(Vec3d{-2, 1, 1})));
  CHECK(Near(CameraRay(scene.camera, scene.film, 10, 5, random).d, {0, 0, 1}));
  b.Lens(0.3, 4);
  for (int i = 0; i < 100; ++i) {
    const Ray ray = CameraRay(scene.camera, scene.film, 20, 10, random);
    CHECK(Length(ray.o) <= 0.3);
    CHECK(Near(ray.o + (4 / ray.d.z) * ray.d, {8, -4, 4}));
  }
}

TEST_CASE("reference: filters have the moments of their shapes", "[reference]") {
  Random random(2);
  Filter filter;
  for (FilterKind kind :
       {FilterKind::kBox, FilterKind::kTriangle, FilterKind::kGaussian}) {
    filter.kind = kind;
    double squares = 0, expected_top = 0, expected_bottom = 0;
    for (int i = 0; i < 100000; ++i) {
      const double x = SampleFilter(filter, 1.5, random);
      REQUIRE(std::abs(x) <= 1.5);
      squares += x * x / 100000;
    }
    for (int i = 0; i < 1000; ++i) {
      const double x = 1.5 * (i + 0.5) / 1000;
      const double f = kind == FilterKind::kBox ? 1
                       : kind == FilterKind::kTriangle
                           ? 1.5 - x
                           : std::exp(-2 * x * x) - std::exp(-4.5);
      expected_top += x * x * f;
      expected_bottom += f;
    }
    CHECK(squares == Approx(expected_top / expected_bottom).epsilon(0.02));
  }
}

}  // namespace lanelight::reference
