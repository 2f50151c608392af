// The side that triangles face.
#include <catch2/catch.hpp>

#include "tests/scene/compile/bent_strip.h"

namespace lanelight {
namespace {

// ---- pbrt's rule for the orientation of a triangle, written down independently ----

Vec3d InverseTranspose(const Transform& t, Vec3d n) {
  return t.Inverse().Transposed().Vector(n);
}

// Geometric normal of pbrt-v4 at the centroid of triangle i of a mesh: cross product of
// transformed edges, turned round if ReverseOrientation XOR mirrored; then to the side of
// the shading normal, if there is one. `instance` carries the finished normal along.
Vec3d PbrtNormal(const Shape& shape, std::size_t i, const Transform& instance) {
  const Transform& t = shape.world_from_object;
  Vec3d p[3], ns;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t v = shape.mesh->indices[3 * i + k];
    p[k] = t.Point(shape.mesh->positions[v]);
    if (shape.mesh->normals.empty()) continue;
    const Vec3d n = Normalize(InverseTranspose(t, shape.mesh->normals[v]));
    ns += shape.reverse_orientation ? -n : n;
  }
  Vec3d n = Normalize(Cross(p[0] - p[2], p[1] - p[2]));
  if (shape.reverse_orientation != (t.Determinant3() < 0)) n = -n;
  if (Dot(n, ns) < 0) n = -n;
  return Normalize(InverseTranspose(instance, n));
}

TEST_CASE("compile: winding is pbrt's normal in every combination", "[scene][compile]") {
  for (bool reverse : {false, true}) {
    for (bool mirror : {false, true}) {
      for (int side : {0, 1, -1}) {
        INFO("reverse " << reverse << " mirror " << mirror << " normals " << side);
        SceneDescription d = SquareScene();
        d.shapes[0] = MeshShape(Strip(side), 0);
        d.shapes[0].reverse_orientation = reverse;
        d.shapes[0].world_from_object = Skew(mirror);
        const CompiledScene scene = CompileScene(d);
        REQUIRE(scene.geometry.triangles.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec3d expected = PbrtNormal(d.shapes[0], i, Transform());
          CHECK(Dot(FaceNormal(scene.geometry.triangles[i]), expected) > 0.9999);
        }
      }
    }
  }
}

TEST_CASE("compile: winding of instanced and flattened meshes", "[scene][compile]") {
  for (int combination = 0; combination < 16; ++combination) {
    const bool reverse = combination & 1, mirror = combination & 2;
    const bool mirror_instance = combination & 4, emits = combination & 8;
    INFO("combination " << combination);
    SceneDescription d = SquareScene();
    d.shapes.clear();
    d.objects.resize(1);
    Shape shape = MeshShape(Strip(0), 0);
    shape.reverse_orientation = reverse;
    shape.world_from_object = Skew(mirror);
    if (emits) shape.area_light = AddAreaLight(d, {});
    d.objects[0].shapes.push_back(shape);
    Instance instance;
    instance.object = 0;
    instance.world_from_object = Transform::Rotate(70, {1, 0, 2}) *
                                 Transform::Scale({1, mirror_instance ? -1.5 : 1.5, 3}) *
                                 Transform::Translate({-100, 40, 7});
    d.instances.push_back(instance);
    const CompiledScene scene = CompileScene(d);
    REQUIRE(scene.geometry.triangles.size() == 3);
    REQUIRE(scene.geometry.instances.size() == (emits ? 0u : 1u));
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3d n = FaceNormal(scene.geometry.triangles[i]);
      if (!emits) {  // as a kernel does: transposed inverse of scene_from_object
        const float* m = scene.geometry.instances[0].object_from_scene;
        n = Normalize(Vec3d{m[0] * n.x + m[4] * n.y + m[8] * n.z,
                            m[1] * n.x + m[5] * n.y + m[9] * n.z,
                            m[2] * n.x + m[6] * n.y + m[10] * n.z});
      }
      CHECK(Dot(n, PbrtNormal(shape, i, instance.world_from_object)) > 0.9999);
    }
  }
}

}  // namespace
}  // namespace lanelight
