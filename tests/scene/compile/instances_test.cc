// Instances and objects.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/scene/compile/bent_strip.h"

namespace lanelight {
namespace {

TEST_CASE("compile: instance maps are inverse to each other", "[scene][compile]") {
  SceneDescription d = Varied(Transform::Scale({1e4, 1e4, 1e4}));
  d.objects[0].shapes[0].world_from_object =
      Transform::Translate({1e6, 0, 0}) * Transform::Scale({2, 2, 2});
  d.instances[0].world_from_object =
      Transform::Rotate(20, {1, 1, 0}) * Transform::Translate({-1e6, 0, 0});
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.geometry.groups.size() == 2);
  CHECK(scene.geometry.groups[0].end == 3);
  CHECK(scene.geometry.groups[1].end == 6);
  CHECK(scene.geometry.instance_group == std::vector<std::uint32_t>{1});
  // The object fills its own unit space, whatever its size in the world.
  const TriangleRecord& t = scene.geometry.triangles[3];
  CHECK(Length(Vertex(t, 1) - Vertex(t, 0)) > 0.5);
  const float* m = scene.geometry.instances[0].scene_from_object;
  const float* inverse = scene.geometry.instances[0].object_from_scene;
  const auto apply = [](const float* a, Vec3d p) {
    Vec3d q;
    for (int r = 0; r < 3; ++r) {
      q[r] = a[4 * r] * p.x + a[4 * r + 1] * p.y + a[4 * r + 2] * p.z + a[4 * r + 3];
    }
    return q;
  };
  const Vec3d p = Vertex(t, 2);
  const Vec3d world = d.instances[0].world_from_object.Point(
      d.objects[0].shapes[0].world_from_object.Point(
          d.objects[0].shapes[0].mesh->positions[2]));
  const Vec3d expected = (world - scene.center) * scene.scale;
  CHECK(Length(apply(m, p) - expected) < 2e-7);
  // Float32 of the scene, seen from an object 5000 times smaller.
  CHECK(Length(apply(inverse, apply(m, p)) - p) < 2e-7 * 5000);
}

TEST_CASE("compile: objects without instances and quadrics in objects",
          "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.objects.resize(2);
  d.objects[0].shapes.push_back(MeshShape(Square(), 0));
  Shape sphere = SphereShape(1, 0);
  sphere.reverse_orientation = true;
  d.objects[1].shapes.push_back(sphere);
  for (double x : {5.0, -5.0}) {
    Instance instance;
    instance.object = 1;
    instance.world_from_object =
        Transform::Translate({x, 0, 0}) * Transform::Scale({-1, 1, 1});
    d.instances.push_back(instance);
  }
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.geometry.triangles.size() == 2);  // object 0 is never used
  CHECK(scene.geometry.instances.empty());
  CHECK(scene.geometry.groups.size() == 1);
  REQUIRE(scene.geometry.spheres.size() == 2);
  CHECK(scene.geometry.spheres[0].center[0] == Approx(5 * scene.scale));
  // The instance mirrors, the shape does not: ReverseOrientation alone decides.
  CHECK(scene.geometry.spheres[0].normal_sign == -1);
  CHECK_FALSE(scene.features.Has(Feature::kInstances));
}

// Of two objects one is placed twice and has three triangles, the other once and has two.
SceneDescription TwoObjects() {
  SceneDescription d = Varied(Transform::Scale({2, 2, 2}));
  const Transform turned =
      Transform::Rotate(30, {1, 2, 0}) * Transform::Translate({3, 0, 1});
  Instance again = d.instances[0];
  again.world_from_object = turned * Transform::Scale({-1, 1, 1});
  d.instances.push_back(again);
  d.objects.resize(2);
  d.objects[1].shapes.push_back(MeshShape(Square(), 0));
  Instance once;
  once.object = 1;
  once.world_from_object = turned;
  d.instances.push_back(once);
  return d;
}

TEST_CASE("compile: small instances are copied into the world", "[scene][compile]") {
  const SceneDescription d = TwoObjects();
  const auto compile = [&](std::uint64_t max_copies) {
    CompileOptions options;
    options.copied_triangles = max_copies;
    return CompileScene(d, options).geometry;
  };
  const Geometry kept = compile(0);
  const std::uint32_t world = kept.groups[0].end;
  CHECK(kept.instances.size() == 3);
  // The one that is placed once makes nothing larger; the other needs three.
  const Geometry one = compile(2);
  CHECK(one.instance_group == std::vector<std::uint32_t>{1, 1});
  CHECK(one.triangles.size() == world + 2 + 3);
  CHECK(one.groups[0].end == world + 2);
  const Geometry none = compile(3);
  CHECK(none.instances.empty());
  CHECK(none.triangles.size() == world + 2 + 2 * 3);
}

TEST_CASE("compile: copies lie where the instances do", "[scene][compile]") {
  const SceneDescription d = TwoObjects();
  CompileOptions options;
  options.copied_triangles = 3;
  const CompiledScene copied = CompileScene(d, options);
  // World triangles first, then those of the instances in their order.
  std::size_t at = CompileScene(d).geometry.groups[0].end;
  for (const Instance& instance : d.instances) {
    const Shape& shape = d.objects[static_cast<std::size_t>(instance.object)].shapes[0];
    const Transform world = instance.world_from_object * shape.world_from_object;
    for (std::size_t i = 0; i < shape.mesh->indices.size(); i += 3, ++at) {
      Vec3d expected[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d p = world.Point(shape.mesh->positions[shape.mesh->indices[i + k]]);
        expected[k] = (p - copied.center) * copied.scale;
      }
      // Mirrored ones are wound the other way: each corner is one of the three.
      for (int k = 0; k < 3; ++k) {
        const Vec3d v = Vertex(copied.geometry.triangles[at], k);
        double nearest = 1;
        for (const Vec3d& p : expected) nearest = std::min(nearest, Length(v - p));
        CHECK(nearest < 1e-6);
      }
    }
  }
  CHECK(at == copied.geometry.triangles.size());
}

}  // namespace
}  // namespace lanelight
