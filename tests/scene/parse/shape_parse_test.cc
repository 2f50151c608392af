// Shapes whose data stands in the scene file.
#include <catch2/catch.hpp>

#include "src/scene/parse/bilinear_patch.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

Shape ParseShape(const std::string& text) {
  return ParseWorld("Shape " + text).shapes.back();
}

TEST_CASE("spheres, disks, planes", "[parse]") {
  const Shape sphere = ParseShape("\"sphere\" \"float radius\" 2 \"float zmin\" -2");
  CHECK(sphere.kind == ShapeKind::kSphere);
  CHECK(sphere.radius == 2);
  const Shape disk = ParseShape(
      "\"disk\" \"float radius\" 3 \"float innerradius\" 1 \"float height\" 0.5 "
      "\"float phimax\" 360");
  CHECK(disk.kind == ShapeKind::kDisk);
  CHECK(disk.radius == 3);
  CHECK(disk.inner_radius == 1);
  CHECK(disk.height == 0.5);
  CHECK(ParseShape("\"plane\" \"float alpha\" 0.5").kind == ShapeKind::kPlane);
}

TEST_CASE("parts of round shapes", "[parse]") {
  const Shape tube = ParseShape("\"cylinder\" \"float phimax\" 90");
  CHECK(tube.kind == ShapeKind::kCylinder);
  CHECK(tube.radius == 1);
  CHECK(tube.z_min == -1);
  CHECK(tube.z_max == 1);
  CHECK(tube.phi_max == 90);
  // In either order, and cut off at the sphere itself.
  const Shape bowl = ParseShape(
      "\"sphere\" \"float radius\" 2 \"float zmin\" 1.5 \"float zmax\" -9 "
      "\"float phimax\" 400");
  CHECK(bowl.z_min == -2);
  CHECK(bowl.z_max == 1.5);
  CHECK(bowl.phi_max == 360);
  CHECK(ParseShape("\"disk\" \"float phimax\" 20").phi_max == 20);
}

TEST_CASE("round shapes of radius 0 are left out", "[parse]") {
  for (const char* type : {"sphere", "disk", "cylinder"}) {
    const SceneDescription scene =
        ParseWorld(std::string("Shape \"") + type + "\" \"float radius\" 0");
    CHECK(scene.shapes.empty());
    CHECK(HasNote(scene, "its radius is 0"));
  }
}

TEST_CASE("triangle meshes", "[parse]") {
  const Shape shape = ParseShape(R"("trianglemesh"
    "point3 P" [ 0 0 0  1 0 0  1 1 0  0 1 0 ]
    "normal N" [ 0 0 1  0 0 1  0 0 1  0 0 1 ]
    "point2 uv" [ 0 0  1 0  1 1  0 1 ]
    "integer indices" [ 0 1 2  0 2 3 ])");
  REQUIRE(shape.mesh != nullptr);
  CHECK(shape.mesh->positions.size() == 4);
  CHECK(shape.mesh->positions[2] == Vec3d{1, 1, 0});
  CHECK(shape.mesh->normals[3] == Vec3d{0, 0, 1});
  CHECK(shape.mesh->uvs[1] == std::array<double, 2>{1, 0});
  CHECK(shape.mesh->indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  const Shape single = ParseShape("\"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]");
  CHECK(single.mesh->indices == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(single.mesh->uvs.empty());
}

// Sum of the triangles' area vectors.
Vec3d AreaVector(const TriangleMesh& mesh) {
  Vec3d sum;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3d a = mesh.positions[mesh.indices[i]];
    sum += Cross(mesh.positions[mesh.indices[i + 1]] - a,
                 mesh.positions[mesh.indices[i + 2]] - a) *
           0.5;
  }
  return sum;
}

TEST_CASE("flat bilinear patches become two triangles", "[parse]") {
  // Corners in the order p00, p10, p01, p11.
  const Shape square =
      ParseShape("\"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]");
  REQUIRE(square.mesh->indices.size() == 6);
  CHECK(AreaVector(*square.mesh) == Vec3d{0, 0, 1});
  for (std::size_t i = 0; i < 4; ++i) {  // default uv = position on the unit square
    CHECK(square.mesh->uvs[i][0] == square.mesh->positions[i].x);
    CHECK(square.mesh->uvs[i][1] == square.mesh->positions[i].y);
  }
  const Shape two = ParseShape(R"("bilinearmesh"
    "point3 P" [ 0 0 0  1 0 0  0 1 0  1 1 0  0 2 0  1 2 0 ]
    "point2 uv" [ 0 0  1 0  0 1  1 1  0 2  1 2 ]
    "integer indices" [ 0 1 2 3  2 3 4 5 ])");
  CHECK(two.mesh->indices.size() == 12);
  CHECK(AreaVector(*two.mesh) == Vec3d{0, 0, 2});
  CHECK(two.mesh->uvs.back() == std::array<double, 2>{0, 2});
}

TEST_CASE("values of a mesh that are not one per vertex are discarded with a warning",
          "[parse]") {
  const auto warned = [](const std::string& text, const std::string& words) {
    const SceneDescription scene = ParseWorld("Shape " + text);
    CAPTURE(text);
    CHECK(HasWarning(scene, words));
    CHECK(scene.notes.front().where.line == 2);
    return *scene.shapes.at(0).mesh;
  };
  const std::string triangle = R"("trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ] )";
  const std::string patch = R"("bilinearmesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] )";
  CHECK(warned(triangle + R"("point2 uv" [ 0 0 1 0 1 1 0 1 ])", "4 values for 3 vertices")
            .uvs.empty());
  CHECK(warned(triangle + R"("normal N" [ 0 0 1 0 1 0 ])", "2 values for 3 vertices")
            .normals.empty());
  const TriangleMesh plain = *ParseShape(patch).mesh;
  CHECK(warned(patch + R"("point2 uv" [ 5 5 1 0 ])", "\"point2 uv\" of shape").uvs ==
        plain.uvs);
  CHECK(warned(patch + R"("normal N" [ 0 1 1 ])", "1 values for 4 vertices").normals ==
        plain.normals);
  CHECK(warned(triangle + R"("integer indices" [ 0 1 2 0 1 ])", "the last 2 discarded")
            .indices.size() == 3);
  CHECK_THAT(WorldError("Shape " + triangle + R"("integer indices" [ 0 1 ])"),
             Catch::Contains("a face takes 3"));
}

TEST_CASE("quads are split along the diagonal that stays inside", "[parse]") {
  const QuadSplit convex = SplitQuad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
  CHECK(convex.is_flat);
  CHECK(convex.is_simple);
  CHECK(convex.corners == std::array<int, 6>{0, 1, 2, 0, 2, 3});
  // Concave at corner 1: 0-2 runs outside.
  const QuadSplit concave = SplitQuad({{{0, 0, 0}, {1, 0.9, 0}, {2, 0, 0}, {1, 3, 0}}});
  CHECK(concave.is_simple);
  CHECK(concave.corners == std::array<int, 6>{0, 1, 3, 1, 2, 3});
  CHECK_FALSE(SplitQuad({{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}}).is_simple);
  const QuadSplit bent = SplitQuad({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}}});
  CHECK_FALSE(bent.is_flat);
  CHECK(bent.is_simple);
}

TEST_CASE("flatness does not depend on units or, within rounding, on place", "[parse]") {
  for (const double unit : {1e-150, 1e-9, 1.0, 1e9, 1e150}) {
    CAPTURE(unit);
    const auto quad = [&](double lift) {
      return std::array<Vec3d, 4>{
          {{0, 0, 0}, {unit, 0, 0}, {unit, unit, lift * unit}, {0, unit, 0}}};
    };
    CHECK(SplitQuad(quad(0)).is_flat);
    CHECK(SplitQuad(quad(1e-7)).is_flat);
    CHECK_FALSE(SplitQuad(quad(1e-3)).is_flat);
  }
  CHECK(SplitQuad({{{5, 5, 5}, {5, 5, 5}, {5, 5, 5}, {5, 5, 5}}}).is_flat);
  CHECK(SplitQuad({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}}}).is_simple);
}

}  // namespace
}  // namespace lanelight
