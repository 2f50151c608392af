// Small scenes with media for the tests of this folder.
#pragma once

#include "tests/reference/scenes.h"

namespace lanelight::test {

inline Medium MakeMedium(Rgb sigma_a, Rgb sigma_s, double g = 0, Rgb emission = {}) {
  Medium medium;
  medium.sigma_a = sigma_a;
  medium.sigma_s = sigma_s;
  medium.g = g;
  medium.emission = emission;
  return medium;
}

inline Index AddMedium(SceneBuilder& b, const Medium& medium) {
  b.scene().media.push_back(medium);
  return static_cast<Index>(b.scene().media.size()) - 1;
}

inline Index AddInterface(SceneBuilder& b) {
  Material material;
  material.kind = MaterialKind::kInterface;
  return b.AddMaterial(material);
}

/// The media beside the shape added last.
inline void Bound(SceneBuilder& b, Index inside, Index outside) {
  b.scene().shapes.back().media = {inside, outside};
}

/// A room's corner in coloured fog, camera and lights inside it: no surface bounds it.
inline SceneDescription Fog(int size = 8) {
  SceneBuilder b(size, size);
  b.Depth(4).Perspective({0, -4, 1.5}, {0, 0, 0.6}, {0, 0, 1}, 40);
  const Index grey = b.AddDiffuse({0.5, 0.4, 0.3});
  b.AddPlane({0, 0, 0}, {0, 0, 1}, grey);
  b.AddSphere({0.3, 0, 0.4}, 0.4, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3));
  b.AddQuad({-1, -1, 2}, {0, 1, 0}, {1, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({8, 7, 6}));
  b.AddPoint({-1, -1, 1}, {2, 2, 2});
  b.scene().camera.medium =
      AddMedium(b, MakeMedium({0.02, 0.05, 0.1}, {0.3, 0.2, 0.1}, 0.4));
  return b.Build();
}

/// A cloud of one medium inside a cloud of another inside empty space, behind interfaces
/// of spheres and triangles, over a floor, beside a wall that bounds nothing.
inline SceneDescription NestedClouds(int size = 8) {
  SceneBuilder b(size, size);
  b.Depth(5).Perspective({0, -5, 1.5}, {0, 0, 0.9}, {0, 0, 1}, 40);
  const Index grey = b.AddDiffuse({0.6, 0.5, 0.4}), interface = AddInterface(b);
  const Index thin = AddMedium(b, MakeMedium({0.1, 0.2, 0.3}, {0.5, 0.7, 0.2}, -0.3));
  const Index dense =
      AddMedium(b, MakeMedium({1, 0.1, 0.5}, {2, 6, 3}, 0.6, {0.3, 0.2, 0.1}));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, grey);
  b.AddBox({-1.2, -1, 0.2}, {1.2, 1, 1.8}, interface);
  Bound(b, thin, kNone);
  b.AddSphere({0.2, 0.1, 1}, 0.5, interface);
  Bound(b, dense, thin);
  b.AddSphere({-0.7, 0, 1}, 0.2, grey);
  b.AddQuad({-1, -1, 3}, {0, 2, 0}, {2, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({5, 5, 4}));
  b.AddPoint({1.6, -0.5, 1.2}, {1, 1.5, 2});
  b.AddEnvironment({0.2, 0.25, 0.3});
  return b.Build();
}

/// The same, with an outer cloud that varies.
inline SceneDescription NestedSmoke(int size = 8) {
  SceneDescription scene = NestedClouds(size);
  Medium& thin = scene.media[0];
  thin.kind = MediumKind::kUniformGrid;
  thin.grid_size[0] = thin.grid_size[1] = thin.grid_size[2] = 3;
  for (int i = 0; i < 27; ++i) thin.grid.push_back(i % 5 == 1 ? 3.0f : 0.2f * (i % 4));
  thin.box_min = {-1.2, -1, 0.2};
  thin.box_max = {1.2, 1, 1.8};
  return scene;
}

/// A glass ball full of milk-like liquid, half of it sunk into a block of fog.
inline SceneDescription FilledGlass(int size = 8) {
  SceneBuilder b(size, size);
  b.Depth(6).Perspective({0, -4, 1.2}, {0, 0, 0.5}, {0, 0, 1}, 34);
  const Index grey = b.AddDiffuse({0.5, 0.5, 0.6});
  const Index milk = AddMedium(b, MakeMedium({0.1, 0.4, 0.9}, {3, 2, 1}, 0.2));
  const Index fog = AddMedium(b, MakeMedium({0.05, 0.05, 0.05}, {0.3, 0.3, 0.3}));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, grey);
  b.AddSphere({0, 0, 0.6}, 0.5, b.AddDielectric(1.3));
  Bound(b, milk, fog);
  b.AddSphere({0, 0, 0.5}, 2.5, AddInterface(b));
  Bound(b, fog, kNone);
  b.AddSphere({0, -0.5, 2}, 0.4, b.AddDiffuse(Grey(0)), b.AddEmission({9, 9, 9}));
  b.AddEnvironment({0.3, 0.3, 0.3});
  return b.Build();
}

/// Smoke of two kinds: a lump of varying density, turned and squeezed, emitting, and a
/// box whose colour varies, side by side over a floor.
inline SceneDescription Smoke(int size = 8) {
  SceneBuilder b(size, size);
  b.Depth(4).Perspective({0, -5, 1.5}, {0, 0, 0.8}, {0, 0, 1}, 40);
  const Index grey = b.AddDiffuse({0.6, 0.5, 0.4}), interface = AddInterface(b);
  Medium lump = MakeMedium({0.4, 0.8, 1.5}, {2, 1.5, 1}, 0.4, {0.4, 0.3, 0.2});
  lump.kind = MediumKind::kUniformGrid;
  lump.grid_size[0] = 4, lump.grid_size[1] = 3, lump.grid_size[2] = 5;
  for (int i = 0; i < 60; ++i) lump.grid.push_back(i % 7 == 3 ? 6.0f : 0.1f * (i % 5));
  lump.box_min = {-1, -1, -1};
  lump.box_max = {1, 1, 1};
  lump.world_from_medium = Transform::Translate({-0.8, 0, 0.9}) *
                           Transform::Rotate(30, {1, 1, 0}) *
                           Transform::Scale({0.6, 0.5, 0.7});
  Medium colored = MakeMedium({}, {}, -0.3);
  colored.kind = MediumKind::kRgbGrid;
  colored.grid_size[0] = 2, colored.grid_size[1] = 1, colored.grid_size[2] = 3;
  for (int i = 0; i < 36; ++i) colored.grid.push_back(0.3f * static_cast<float>(i % 8));
  colored.box_min = {0.2, -0.5, 0.3};
  colored.box_max = {1.4, 0.6, 1.5};
  b.AddPlane({0, 0, 0}, {0, 0, 1}, grey);
  b.AddSphere({-0.8, 0, 0.9}, 0.8, interface);
  Bound(b, AddMedium(b, lump), kNone);
  b.AddBox({0.2, -0.5, 0.3}, {1.4, 0.6, 1.5}, interface);
  Bound(b, AddMedium(b, colored), kNone);
  b.AddQuad({-1, -1, 3}, {0, 2, 0}, {2, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({5, 5, 4}));
  b.AddEnvironment({0.3, 0.3, 0.3});
  return b.Build();
}

}  // namespace lanelight::test
