// Meshes that textures displace.
#include "src/scene/parse/displace.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "src/base/image/image.h"
#include "src/scene/parse/mesh_edges.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/scene/parse/height_textures.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

// The unit square in the plane z = 0, u = x and v = y.
TriangleMesh Square() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

double LongestSide(const TriangleMesh& mesh, const Transform& t) {
  double longest = 0;
  for (const MeshEdge& edge : FindEdges(mesh).edges) {
    longest = std::max(longest, Length(t.Vector(mesh.positions[edge.ends[0]] -
                                                mesh.positions[edge.ends[1]])));
  }
  return longest;
}

TEST_CASE("displaced: sides are short enough, and there are no cracks", "[parse]") {
  const std::vector<Texture> textures = {Constant(0.25)};
  const HeightTexture height(textures, 0);
  for (const Transform& t : {Transform(), Transform::Scale({3, 1, 1})}) {
    const TriangleMesh out = Displace(Square(), t, 0.3, height);
    CHECK(LongestSide(out, t) < 0.3);
    CHECK(LongestSide(out, t) > 0.12);
    const MeshEdges edges = FindEdges(out);
    CHECK(edges.problem == "");
    double outline = 0, area = 0;
    for (const MeshEdge& edge : edges.edges) {
      if (edge.faces > 1) continue;
      outline += Length(out.positions[edge.ends[0]] - out.positions[edge.ends[1]]);
    }
    for (std::size_t i = 0; i < out.indices.size(); i += 3) {
      const Vec3d p = out.positions[out.indices[i]];
      area += Cross(out.positions[out.indices[i + 1]] - p,
                    out.positions[out.indices[i + 2]] - p)
                  .z /
              2;
    }
    CHECK(outline == Approx(4));
    CHECK(area == Approx(1));
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
      CHECK(out.positions[i].z == 0.25);
      CHECK(out.uvs[i][0] == out.positions[i].x);
      CHECK(out.normals[i] == Vec3d{0, 0, 1});
    }
  }
}

TEST_CASE("displaced: along given normals, by the texture, with new normals", "[parse]") {
  // A ramp: the image's two texels, one above the other, and linear in between.
  const TemporaryFolder folder;
  Image ramp = MakeImage(1, 2, {"Y"});
  ramp.At(0, 0, 0) = 1;
  WritePfm(folder.File("ramp.pfm"), ramp);
  std::vector<Texture> textures = {
      FromFile(folder.File("ramp.pfm"), WrapMode::kClamp, true)};
  textures[0].mapping = {1, 0.5, 0, 0.25};  // from one texel's middle to the other's
  TriangleMesh mesh = Square();
  mesh.normals.assign(4, {0, 0, -2});
  const TriangleMesh out = Displace(mesh, Transform(), 0.2, HeightTexture(textures, 0));
  double off = 0, turned = 0;
  for (std::size_t i = 0; i < out.positions.size(); ++i) {
    // Vertices of the file keep the length of their normals, others have unit ones.
    const double reach = i < 4 ? 2 : 1;
    off = std::max(off, std::abs(out.positions[i].z + reach * out.positions[i].y));
  }
  CHECK(off < 1e-7);
  mesh.normals.assign(4, {0, 0, -1});
  const TriangleMesh unit = Displace(mesh, Transform(), 0.2, HeightTexture(textures, 0));
  for (const Vec3d& n : unit.normals) {
    turned = std::max(turned, Length(n - Normalize(Vec3d{0, 1, 1})));
  }
  CHECK(turned < 1e-6);
}

TEST_CASE("displaced: too many triangles are refused before allocation", "[parse]") {
  const std::vector<Texture> textures = {Constant(0.25)};
  CHECK_THROWS_WITH(Displace(Square(), Transform(), 1e-6, HeightTexture(textures, 0)),
                    Catch::Contains("displacement makes more than 50000000 triangles"));
}

TEST_CASE("displaced meshes of a scene", "[parse]") {
  const TemporaryFolder folder;
  const char kHead[] =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\n";
  const char kFaces[] =
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  std::ofstream(folder.File("uv.ply"))
      << kHead << "property float u\nproperty float v\n"
      << kFaces << "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
  std::ofstream(folder.File("plain.ply"))
      << kHead << kFaces << "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const auto parse = [&](const std::string& shape) {
    return ParseSceneText(
        "WorldBegin Texture \"h\" \"float\" \"constant\" \"float value\" 0.5\n" + shape,
        "main.pbrt", std::filesystem::path(folder.File("uv.ply")).parent_path().string());
  };
  const std::string displaced = "\"texture displacement\" \"h\" \"float edgelength\" 0.4";
  // The same file, displaced and as it is.
  const SceneDescription scene =
      parse("Shape \"plymesh\" \"string filename\" \"uv.ply\" " + displaced +
            "\nShape \"plymesh\" \"string filename\" \"uv.ply\"");
  CHECK(scene.notes.empty());
  CHECK(scene.shapes[0].mesh->indices.size() > 3 * 10);
  for (const Vec3d& p : scene.shapes[0].mesh->positions) CHECK(p.z == 0.5);
  CHECK(scene.shapes[1].mesh->indices.size() == 3);
  const SceneDescription coarse = ParseSceneText(
      "Option \"displacementedgescale\" 10 WorldBegin Texture \"h\" \"float\" "
      "\"constant\" Shape \"plymesh\" \"string filename\" \"uv.ply\" " +
          displaced,
      "main.pbrt", std::filesystem::path(folder.File("uv.ply")).parent_path().string());
  CHECK(coarse.shapes[0].mesh->indices.size() == 3);
  // The name that pbrt-v4 has on GPUs means the same.
  const SceneDescription named = parse(
      "Shape \"plymesh\" \"string filename\" \"uv.ply\" \"texture displacement\" "
      "\"h\" \"float displacement.edgelength\" 0.4");
  CHECK(named.shapes[0].mesh->indices == scene.shapes[0].mesh->indices);
  CHECK(HasNote(named, "write \"edgelength\""));
  CHECK_THROWS_WITH(
      parse("Shape \"plymesh\" \"string filename\" \"plain.ply\" " + displaced),
      Catch::StartsWith("main.pbrt:2:17: error: ") &&
          Catch::Contains("no texture coordinates"));
}

}  // namespace
}  // namespace lanelight
