#include "tests/kernels/lights/cut_lamps.h"

#include "tests/kernels/lights/image_strategies.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/reference/scenes.h"

namespace lanelight::test {
namespace {

// Partly there, and by place: what the light's own coordinates do not say.
Texture Cells() {
  Texture cells = Holes(1);
  cells.dimension = 3;
  cells.tex1.constant = Grey(0.3);
  cells.texture_from_world =
      Transform::Translate({0.3, 0.2, 0.4}) * Transform::Scale({2.4, 2.4, 2.4});
  return cells;
}

SceneBuilder Floor() {
  SceneBuilder b(8, 8);
  b.Depth(2).Perspective({0, -4, 2.2}, {0, 0, 0.7}, {0, 0, 1}, 50);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.6, 0.5, 0.4}));
  return b;
}

TriangleMesh Sail() {
  TriangleMesh sail;
  sail.positions = {{0.1, 0.4, 0.2}, {1.1, 0.2, 0.3}, {0.6, 0.5, 1.3}};
  sail.uvs = {{0.9, 0.1}, {0.2, 0.3}, {0.4, 1.2}};
  sail.indices = {0, 1, 2};
  return sail;
}

void MakeUnseen(Shape& shape) { shape.alpha.constant = 0; }

}  // namespace

Texture Holes(double cells) {
  Texture holes;
  holes.kind = TextureKind::kCheckerboard;
  holes.is_float = true;
  holes.tex1.constant = Grey(1);
  holes.tex2.constant = Grey(0);
  holes.mapping.su = holes.mapping.sv = cells;
  return holes;
}

SceneDescription CutLamps() {
  SceneBuilder b = Floor();
  b.scene().textures = {Holes(3), Cells()};
  const Index dark = b.AddDiffuse(Grey(0.2));
  b.AddQuad({-1.6, 0.6, 0.4}, {0, 0, 0.9}, {1.3, 0, 0}, dark, b.AddEmission({2, 3, 1}))
      .alpha.texture = 0;
  b.AddMesh(Sail(), dark, b.AddEmission({3, 3, 3}, true)).alpha.texture = 1;
  b.AddDisk({1.2, -0.6, 0.8}, {-0.4, -0.5, 0.8}, 0.4, dark, b.AddEmission(Grey(2), true))
      .alpha.texture = 0;
  b.scene().area_lights.back().image_path = Picture("wide.exr", kWide, kHigh, Patchwork);
  b.AddDisk({0, 0, 2.5}, {0, 0, -1}, 0.3, dark, b.AddEmission(Grey(3))).alpha.constant =
      0.4;
  return b.Build();
}

SceneDescription CutBalls() {
  SceneBuilder b = Floor();
  b.scene().textures = {Holes(4), Cells()};
  const Index dark = b.AddDiffuse(Grey(0.2));
  b.AddSphere({-0.6, -0.3, 0.5}, 0.45, dark, b.AddEmission({1, 2, 3}, true))
      .alpha.texture = 0;
  Shape& lantern = b.AddSphere({0.8, 0, 0.5}, 0.4, dark, b.AddEmission({5, 3, 2}));
  lantern.reverse_orientation = true;
  lantern.alpha.texture = 1;
  b.AddSphere({0.1, 0.9, 1}, 0.3, dark, b.AddEmission(Grey(2))).alpha.texture = 0;
  b.AddSphere({0, 0, 2.6}, 0.2, dark, b.AddEmission(Grey(4)));
  return b.Build();
}

SceneDescription UnseenLamps() {
  SceneBuilder b = Floor();
  const Index dark = b.AddDiffuse(Grey(0.2));
  MakeUnseen(b.AddQuad({-1.6, 0.6, 0.4}, {0, 0, 0.9}, {1.3, 0, 0}, dark,
                       b.AddEmission({2, 3, 1})));
  MakeUnseen(b.AddMesh(Sail(), dark, b.AddEmission({3, 3, 3}, true)));
  MakeUnseen(b.AddDisk({1.2, -0.6, 0.8}, {-0.4, -0.5, 0.8}, 0.4, dark,
                       b.AddEmission(Grey(2), true)));
  MakeUnseen(b.AddSphere({-0.6, -0.3, 0.5}, 0.3, dark, b.AddEmission({1, 2, 3}, true)));
  b.AddSphere({0.3, 0.3, 0.3}, 0.2, dark, b.AddEmission(Grey(2)));
  return b.Build();
}

SceneDescription MixedLamps() {
  SceneBuilder b = Floor();
  b.Depth(3);
  b.scene().textures = {Holes(3), Cells()};
  const Index dark = b.AddDiffuse(Grey(0.3));
  b.AddQuad({-1.6, 0.6, 0.2}, {0, 0, 1.2}, {1.5, 0, 0}, dark, b.AddEmission({2, 3, 1}))
      .alpha.texture = 0;
  b.AddSphere({0.9, 0, 0.6}, 0.5, dark, b.AddEmission({1, 2, 3}, true)).alpha.texture = 0;
  b.AddDisk({0, 0, 2.5}, {0, 0, -1}, 0.8, dark, b.AddEmission(Grey(2))).alpha.constant =
      0.4;
  MakeUnseen(b.AddDisk({-0.5, -0.6, 1}, {0.4, 0.3, -0.8}, 0.3, dark,
                       b.AddEmission({3, 2, 1}, true)));
  return b.Build();
}

}  // namespace lanelight::test
