// One bad number in a mesh file costs what it stands for, and no more.
#include "src/scene/parse/ply.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/render/run/render_fixture.h"
#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

// A square of two triangles and a collapsed one, in the plane z = 0. Every normal leans
// over by 45 degrees; `bad` stands in the normal of corner 2.
std::string Square(const std::string& bad_normal, const std::string& bad_uv = "1",
                   const std::string& bad_z = "0") {
  return "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
         "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
         "property float u\nproperty float v\n"
         "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0  1 0 1  0 0\n1 0 0  1 0 1  1 0\n1 1 0  " +
         bad_normal + " 0 1  1 " + bad_uv + "\n0 1 " + bad_z +
         "  1 0 1  0 1\n1 1 0  1 0 1  0 0\n3 0 1 2\n3 0 2 3\n3 1 2 4\n";
}

PlyMesh Parse(const std::string& text) { return ParsePly(text, "m.ply"); }

TEST_CASE("non-finite normals are replaced by face normals", "[parse][ply]") {
  for (const char* bad : {"nan", "inf", "-inf"}) {
    CAPTURE(bad);
    const PlyMesh ply = Parse(Square(bad));
    CHECK(ply.bad_normals == 1);
    CHECK(ply.mesh.indices.size() == 9);
    SceneDescription d = SquareScene();
    d.shapes[0] = MeshShape(ply.mesh, 0);
    const CompiledScene scene = CompileScene(d);
    REQUIRE(scene.geometry.triangles.size() == 2);
    REQUIRE(scene.geometry.normals.size() == 18);
    const Vec3d leaning = Normalize(Vec3d{1, 0, 1});
    for (int corner = 0; corner < 6; ++corner) {
      const TriangleRecord& t = scene.geometry.triangles[corner / 3];
      const Vec3d n = ToVec(&scene.geometry.normals[3 * corner]);
      const Vec3d p = Vertex(t, corner % 3) / scene.scale + scene.center;
      const bool is_bad = p.x > 0.5 && p.y > 0.5;
      CHECK(Length(n - (is_bad ? Vec3d{0, 0, 1} : leaning)) < 1e-6);
    }
  }
  CHECK(Parse(Square("1")).bad_normals == 0);
}

TEST_CASE("non-finite uvs and positions are repaired", "[parse][ply]") {
  const PlyMesh uv = Parse(Square("1", "nan"));
  CHECK(uv.bad_uvs == 1);
  CHECK(uv.mesh.uvs[2] == std::array<double, 2>{0, 0});
  CHECK(uv.mesh.uvs[3] == std::array<double, 2>{0, 1});
  CHECK(uv.lost_triangles == 0);
  const PlyMesh place = Parse(Square("1", "1", "inf"));
  CHECK(place.lost_triangles == 1);
  CHECK(place.mesh.indices == std::vector<std::uint32_t>{0, 1, 2, 1, 2, 4});
}

TEST_CASE("faces of other than 3 or 4 corners are left out", "[parse][ply]") {
  const PlyMesh ply = Parse(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement face 3\nproperty list uchar int vertex_indices\n"
      "end_header\n0 0 0 1 0 0 1 1 0 0 1 0 0 2 0\n5 0 1 2 3 4\n3 0 1 2\n2 0 1\n");
  CHECK(ply.other_faces == 2);
  CHECK(ply.mesh.indices == std::vector<std::uint32_t>{0, 1, 2});
}

TEST_CASE("a scene with bad numbers in its mesh renders, with notes", "[parse][ply]") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "lanelight_ply_repair_test";
  fs::create_directories(folder);
  std::ofstream(folder / "bad.ply") << Square("nan", "nan", "nan");
  const SceneDescription scene = ParseSceneText(
      R"(LookAt 0.5 0.5 3  0.5 0.5 0  0 1 0  Camera "perspective" "float fov" 30
      Film "rgb" "integer xresolution" 8 "integer yresolution" 8
      WorldBegin LightSource "infinite" "rgb L" [ 1 1 1 ]
      Texture "c" "spectrum" "checkerboard"
      Material "diffuse" "texture reflectance" "c"
      Shape "plymesh" "string filename" "bad.ply")",
      "main.pbrt", folder.string());
  fs::remove_all(folder);
  REQUIRE(scene.notes.size() == 3);
  CHECK(scene.notes[0].message.starts_with("1 vertices of"));
  CHECK(scene.notes[0].where.ToString().find("main.pbrt:6:") == 0);
  const Rendered render = RenderDescription(scene, {});
  CHECK(render.result.health.Total() == 0);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const Rgb mean = render.film.Mean(x, y);
      CHECK(std::isfinite(mean.x + mean.y + mean.z));
    }
  }
}

}  // namespace
}  // namespace lanelight
