// Normalisation, winding, normals, texture coordinates, instances, degenerate triangles.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "tests/compile/testing.h"

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

// A bent strip of three triangles, with normals tilted to the chosen side.
TriangleMesh Strip(int normal_side) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0.3}, {1, 1, 0}, {0, 1.2, 0.1}, {-0.5, 0.5, 0.7}};
  mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4};
  if (normal_side == 0) return mesh;
  const double s = normal_side;
  mesh.normals = {{-0.3 * s, 0.1 * s, s},
                  {-0.3 * s, 0, 2 * s},
                  {0, 0.2 * s, s},
                  {0.1 * s, 0, 0.8 * s},
                  {0.6 * s, 0, s}};
  return mesh;
}

Transform Skew(bool mirror) {
  return Transform::Translate({3, -2, 5}) * Transform::Rotate(40, {1, 2, 3}) *
         Transform::Scale({mirror ? -2.0 : 2.0, 1, 0.5});
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

TEST_CASE("compile: vertices, uvs and normals are permuted alike", "[scene][compile]") {
  SceneDescription d = SquareScene();
  TriangleMesh mesh = Strip(1);
  // uv and normal identify the vertex.
  for (std::size_t v = 0; v < 5; ++v) mesh.uvs.push_back({double(v), double(v) * 10});
  d.shapes[0] = MeshShape(mesh, 0);
  Texture checker;
  checker.kind = TextureKind::kCheckerboard;
  d.materials[0].reflectance.texture = AddTexture(d, checker);
  for (bool reverse : {false, true}) {
    d.shapes[0].reverse_orientation = reverse;
    const CompiledScene scene = CompileScene(d);
    const Geometry& g = scene.geometry;
    REQUIRE(g.uvs.size() == 18);
    REQUIRE(g.normals.size() == 27);
    CHECK(scene.features.Has(Feature::kVertexNormals));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(g.uvs[6 * i + 2 * k]);
        CHECK(g.uvs[6 * i + 2 * k + 1] == 10.0f * static_cast<float>(v));
        const Vec3d p = (mesh.positions[v] - scene.center) * scene.scale;
        CHECK(Length(Vertex(g.triangles[i], static_cast<int>(k)) - p) < 1e-6);
        const Vec3d n = Normalize(mesh.normals[v]) * (reverse ? -1.0 : 1.0);
        CHECK(Length(ToVec(&g.normals[9 * i + 3 * k]) - n) < 1e-6);
      }
      // The first vertex stays the first.
      CHECK(g.uvs[6 * i] == 0.0f);
    }
  }
}

TEST_CASE("compile: default texture coordinates are pbrt's", "[scene][compile]") {
  SceneDescription d = SquareScene();
  Texture checker;
  checker.kind = TextureKind::kCheckerboard;
  d.materials[0].reflectance.texture = AddTexture(d, checker);
  const CompiledScene scene = CompileScene(d);
  const std::vector<float> expected = {0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 1};
  CHECK(std::equal(expected.begin(), expected.end(), scene.geometry.uvs.begin(),
                   scene.geometry.uvs.end()));
}

TEST_CASE("compile: vertex normals equal to face normals are dropped",
          "[scene][compile]") {
  SceneDescription d = SquareScene();
  TriangleMesh mesh = Square();
  mesh.normals.assign(4, {4.4e-8, 0, 2});
  d.shapes[0] = MeshShape(mesh, 0);
  CHECK(CompileScene(d).geometry.normals.empty());
  CHECK_FALSE(CompileScene(d).features.Has(Feature::kVertexNormals));
  // The other side: the triangles turn, the normals are still face normals.
  mesh.normals.assign(4, {0, 0, -1});
  d.shapes[0] = MeshShape(mesh, 0);
  CHECK_FALSE(CompileScene(d).features.Has(Feature::kVertexNormals));
  CHECK(FaceNormal(CompileScene(d).geometry.triangles[0]).z == -1);
  mesh.normals[2] = {0.01, 0, -1};
  d.shapes[0] = MeshShape(mesh, 0);
  CHECK(CompileScene(d).features.Has(Feature::kVertexNormals));
}

TEST_CASE("compile: missing normals hold the face normal", "[scene][compile]") {
  SceneDescription d = SquareScene();
  TriangleMesh mesh = Square();
  mesh.normals = {{0, 0, 0}, {0.5, 0, 1}, {0, 0, 1}, {0, 0, 0}};
  d.shapes[0] = MeshShape(mesh, 0);
  d.shapes.push_back(MeshShape(Square(), 0));  // no normals at all
  d.shapes[1].reverse_orientation = true;
  d.shapes[1].world_from_object = Transform::Translate({0, 0, 1});
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.geometry.normals.size() == 36);
  CHECK(ToVec(&scene.geometry.normals[0]) == Vec3d{0, 0, 1});
  for (std::size_t k = 0; k < 6; ++k) {
    CHECK(ToVec(&scene.geometry.normals[18 + 3 * k]) == Vec3d{0, 0, -1});
  }
}

TEST_CASE("compile: frame", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes[0].world_from_object =
      Transform::Translate({100, 200, 300}) * Transform::Scale({10, 10, 10});
  d.camera.world_from_camera = Transform::Translate({1e6, 0, 0});  // does not count
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.center == Vec3d{100, 200, 300});
  // Half diagonal 10 sqrt 2 = 14.14 -> 1.77.
  CHECK(scene.scale == 0.125);
  CHECK(Vertex(scene.geometry.triangles[0], 0) == Vec3d{-1.25, -1.25, 0});
  CHECK(scene.geometry.bounds_min.x == Approx(-1.25));
  CHECK(scene.geometry.bounds_min.x < -1.25f);
  CHECK(scene.geometry.bounds_max.y > 1.25f);
}

TEST_CASE("compile: a scene of planes alone is framed by the camera",
          "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes = {PlaneShape(0)};
  d.shapes[0].world_from_object = Transform::Translate({0, 0, -6});
  d.camera.world_from_camera = Transform::Translate({50, 0, 0});
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.center == Vec3d{50, 0, -3});  // between the camera and its foot
  CHECK(scene.scale == 0.5);                // half diagonal 3 -> 1.5
  CHECK(scene.geometry.planes[0].point[2] == Approx(-1.5));
}

// All floats of a scene that depend on positions.
std::vector<float> Coordinates(const CompiledScene& scene) {
  std::vector<float> out;
  for (const TriangleRecord& t : scene.geometry.triangles) {
    for (const auto& p : t.p) out.insert(out.end(), p, p + 3);
  }
  for (const SphereRecord& s : scene.geometry.spheres) {
    out.insert(out.end(), s.center, s.center + 3);
    out.push_back(s.radius);
  }
  for (const InstanceRecord& i : scene.geometry.instances) {
    out.insert(out.end(), i.scene_from_object, i.scene_from_object + 12);
  }
  for (const LightRecord& l : scene.lights.lights) {
    out.insert(out.end(), l.position, l.position + 3);
    out.push_back(l.area);
  }
  for (int i = 0; i < 3; ++i) out.push_back(scene.camera.origin[i]);
  return out;
}

SceneDescription Varied(const Transform& outer) {
  SceneDescription d = SquareScene();
  d.shapes[0] = MeshShape(Strip(1), 0);
  d.shapes.push_back(SphereShape(0.7, 0));
  d.shapes[1].world_from_object = Transform::Translate({0.3, 0.2, -1});
  d.shapes[1].area_light = AddAreaLight(d, {});
  for (Shape& shape : d.shapes) shape.world_from_object = outer * shape.world_from_object;
  d.objects.resize(1);
  d.objects[0].shapes.push_back(MeshShape(Strip(0), 0));
  Instance instance;
  instance.object = 0;
  instance.world_from_object = outer * Transform::Rotate(30, {0, 1, 0});
  d.instances.push_back(instance);
  Light light;
  light.from = {1, 2, 3};
  light.emission = {1, 1, 1};
  light.world_from_light = outer;
  d.lights.push_back(light);
  d.camera.world_from_camera = outer * Transform::Translate({0.1, 0.2, -3});
  return d;
}

TEST_CASE("compile: powers of two and offsets change nothing", "[scene][compile]") {
  const std::vector<float> expected = Coordinates(CompileScene(Varied(Transform())));
  for (int exponent : {-100, -30, 30, 100}) {
    const double s = std::ldexp(1.0, exponent);
    const auto got = Coordinates(CompileScene(Varied(Transform::Scale({s, s, s}))));
    CHECK(got == expected);
  }
  // Far away the positions in the file are rounded, to 1e-9 of the size here.
  for (double offset : {1e3, 1e7}) {
    const auto got = Coordinates(
        CompileScene(Varied(Transform::Translate({offset, -2 * offset, offset}))));
    REQUIRE(got.size() == expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      CHECK(std::abs(got[i] - expected[i]) <= 2.4e-7 * (1 + std::abs(expected[i])));
    }
  }
}

TEST_CASE("compile: any scale from 1e-9 to 1e9", "[scene][compile]") {
  const CompiledScene unit = CompileScene(Varied(Transform()));
  const std::vector<float> expected = Coordinates(unit);
  for (double s : {1e-9, 1e-3, 1e9}) {
    const CompiledScene scene = CompileScene(Varied(Transform::Scale({s, s, s})));
    const double ratio = s * scene.scale / unit.scale;  // in (1/2, 2)
    CHECK(ratio > 0.5);
    CHECK(ratio < 2);
    const TriangleRecord& a = unit.geometry.triangles[1];
    const TriangleRecord& b = scene.geometry.triangles[1];
    for (int k = 0; k < 3; ++k) {
      CHECK(Length(Vertex(a, k) * ratio - Vertex(b, k)) < 3e-7);
    }
    // The point light's irradiance on the scene does not depend on units, if its
    // intensity is given in the same ones: scale^2.
    CHECK(scene.lights.lights[1].radiance[0] / unit.lights.lights[1].radiance[0] ==
          Approx(ratio * ratio / s / s));
  }
}

TEST_CASE("compile: a tiny mesh placed far away keeps its shape", "[scene][compile]") {
  // The vertices are exact in their own coordinates; the translation is huge. Rounding in
  // world coordinates would leave 1e-9 / 1e-4 = 1e-5 of relative error.
  SceneDescription d = SquareScene();
  const double size = 1e-4 / 3;
  d.shapes[0].world_from_object = Transform::Translate({1e7 / 3, -1e7 / 7, 1e7}) *
                                  Transform::Scale({size, size, size});
  const CompiledScene scene = CompileScene(d);
  const TriangleRecord& t = scene.geometry.triangles[0];
  const Vec3d edge = Vertex(t, 1) - Vertex(t, 0);
  CHECK(edge.x == Approx(2 * size * scene.scale).epsilon(3e-7));
}

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

TEST_CASE("compile: degenerate triangles are left out and noted", "[scene][compile]") {
  SceneDescription d = SquareScene();
  TriangleMesh mesh = Square();
  mesh.positions.push_back({0, 0, 0});
  mesh.positions.push_back({0.5, 0.5 + 1e-12, 0});
  mesh.positions.push_back({0, std::nan(""), 0});
  // Bad ones: a corner twice (two), on a line after rounding, not finite.
  mesh.indices = {0, 1, 1, 0, 1, 2, 1, 2, 1, 0, 2, 3, 4, 5, 2, 4, 1, 2, 0, 1, 6};
  d.shapes[0] = MeshShape(mesh, 0);
  d.shapes[0].area_light = AddAreaLight(d, {});
  d.shapes.push_back(MeshShape(Square(), 0));
  d.shapes[1].world_from_object = Transform::Translate({0, 0, 1});
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.geometry.triangles.size() == 5);
  CHECK(scene.geometry.groups[0].end == 5);
  CHECK(scene.geometry.triangles[1].p[2][0] == -scene.scale);  // second of the square
  CHECK(scene.geometry.triangles[1].light == 0);               // one light with the first
  CHECK(scene.geometry.triangles[2].light == 1);               // the one of 4 1 2
  CHECK(scene.geometry.triangles[3].light == -1);
  CHECK(scene.lights.lights.size() == 2);
  REQUIRE(scene.notes.size() == 1);
  CHECK(scene.notes[0].where.line == 10);
  CHECK(scene.notes[0].message == "left out 4 degenerate triangles of 7");
}

TEST_CASE("compile: an emitter without area leaves a note", "[scene][compile]") {
  SceneDescription d = SquareScene();
  TriangleMesh mesh = Square();
  mesh.indices = {0, 1, 1};
  d.shapes.push_back(MeshShape(mesh, 0));
  d.shapes[1].area_light = AddAreaLight(d, {});
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.lights.lights.empty());
  REQUIRE(scene.notes.size() == 1);
  CHECK(scene.notes[0].message.find("emits nothing") != std::string::npos);
}

}  // namespace
}  // namespace lanelight
