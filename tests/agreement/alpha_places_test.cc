// Cut-outs by textures that depend on where a point is, rather than on its surface
// coordinates: against the reference, and against the same holes told by coordinates.
#include <catch2/catch.hpp>

#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

using Catch::Contains;

// Holes in cells of space on every shape, and by direction on a ball: share 0.2 to 0.9.
SceneDescription Sieves() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  Texture cells;
  cells.kind = TextureKind::kCheckerboard;
  cells.is_float = true;
  cells.dimension = 3;
  cells.tex1.constant = Grey(0.2);
  cells.tex2.constant = Grey(0.9);
  // No shape lies between two cells.
  cells.texture_from_world =
      Transform::Translate({0.3, 0.2, 0.4}) * Transform::Scale({1.4, 1.4, 1.4});
  Texture poles = cells;
  poles.kind = TextureKind::kDirectionMix;
  poles.direction = {0, 0, 1};
  b.scene().textures = {cells, poles};
  const Index red = b.AddDiffuse({0.7, 0.3, 0.2}), grey = b.AddDiffuse(Grey(0.4));
  b.AddPlane({0, 0, -0.1}, {0, 0, 1}, grey);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, red).alpha.texture = 0;
  b.AddSphere({0.7, 0, 0.6}, 0.5, red).alpha.texture = 1;
  b.AddSphere({-0.6, 0.4, 0.6}, 0.5, red).alpha.texture = 0;
  b.AddQuad({-0.9, -0.8, 0.3}, {1, 0, 0.4}, {0, 1, 0.2}, red).alpha.texture = 0;
  b.AddSphere({0, -1, 3}, 0.6, b.AddDiffuse(Grey(0)), b.AddEmission({4, 4, 3}));
  b.AddEnvironment({0.4, 0.45, 0.5});
  return b.Build();
}

// A square and a ball that the light shines through where `mapping` says.
std::string Lattice(const std::string& mapping) {
  return R"(
    LookAt 0 0 -5  0 0 0  0 1 0
    Camera "perspective" "float fov" 40
    Film "rgb" "integer xresolution" 24 "integer yresolution" 24
    WorldBegin
    LightSource "infinite" "rgb L" [ 1 1 1 ]
    Texture "holes" "float" "checkerboard" )" +
         mapping + R"( "float tex1" 0 "float tex2" 1
    Material "diffuse" "rgb reflectance" [ 0.1 0.1 0.1 ]
    Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
      "point3 P" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ]
      "point2 uv" [ -1 -1  1 -1  1 1  -1 1 ] "texture alpha" "holes")";
}

}  // namespace

TEST_CASE("alpha textures by position agree with the reference", "[agreement]") {
  CheckAgreement(Sieves(), 8192, 2000, 0.05);
}

TEST_CASE("alpha textures by position: another cell size is detected", "[agreement]") {
  const SceneDescription scene = Sieves();
  const auto right = RenderWavefront(scene, 4096);
  for (const std::size_t texture : {0u, 1u}) {
    SceneDescription other = scene;
    std::swap(other.textures[texture].tex1, other.textures[texture].tex2);
    CHECK_FALSE(stat::CompareMeans(RenderWavefront(other, 4096), right).same);
  }
}

TEST_CASE("a planar mapping along the texture coordinates gives the same alpha",
          "[alpha]") {
  const Rendered uv = RenderText(
      Lattice("\"string mapping\" \"uv\" \"float uscale\" 3 \"float vscale\" 3"));
  const Rendered planar =
      RenderText(Lattice("\"string mapping\" \"planar\" \"vector3 v1\" [ 3 0 0 ] "
                         "\"vector3 v2\" [ 0 3 0 ]"));
  int same = 0, open = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      same += uv.film.Mean(x, y) == planar.film.Mean(x, y);
      open += uv.film.Mean(x, y).x == 1;
    }
  }
  CHECK(same > 24 * 24 - 12);  // samples at the edges of cells may round either way
  CHECK(open > 24 * 24 / 4);
  CHECK(open < 24 * 24 * 9 / 10);
}

TEST_CASE("alpha textures by position are refused in instances", "[alpha]") {
  CHECK_THROWS_WITH(RenderText(R"(
    Camera "perspective"
    WorldBegin
    Texture "holes" "float" "wrinkled"
    ObjectBegin "leaf"
      Shape "trianglemesh" "integer indices" [ 0 1 2 ] "point3 P" [ 0 0 1  1 0 1  0 1 1 ]
        "texture alpha" "holes"
    ObjectEnd
    ObjectInstance "leaf")"),
                    Contains("test.pbrt:6:13") && Contains("\"holes\""));
}

}  // namespace lanelight::test
