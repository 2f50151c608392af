// Vertices: their order, normals and texture coordinates; triangles without area.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/scene/compile/bent_strip.h"

namespace lanelight {
namespace {

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
