// Scenes that are hard for some strategy each.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "src/base/image/exr.h"
#include "src/base/image/octahedral.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/kernels/lights/cut_lamps.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/kernels/media/scenes.h"
#include "tests/reference/scenes.h"

namespace lanelight::test::hard {

// A small emitter that scattered rays rarely hit.
inline SceneDescription TinyLight() { return SmallRoom(8, 3, 0.12); }

// A ceiling that is all light: light samples lie mostly at grazing angles.
inline SceneDescription LargeLight() { return SmallRoom(8, 3, 0.95); }

inline SceneDescription GlossyPlates() {
  Material metal;
  metal.kind = MaterialKind::kConductor;
  metal.eta.constant = {0.2, 0.9, 1.1};
  metal.k.constant = {3.9, 2.5, 2.2};
  metal.uroughness.constant = metal.vroughness.constant = 0.15;
  metal.remap_roughness = false;
  SceneDescription scene = Plate(metal, 8, 3);
  return scene;
}

// Radiance of the image of a sky, 8 x 8 texels: dim, with a bright spot.
inline Rgb SkyTexel(int x, int y) {
  if (x == 5 && y == 3) return {3, 2.5, 2};
  return {0.1 + 0.02 * ((x + 2 * y) % 5), 0.15, 0.1 + 0.03 * (y % 3)};
}

inline Rgb SkyRadiance(Index, Vec3d toward) {
  const auto [u, v] = DirectionToOctahedral(toward);
  return SkyTexel(std::min(static_cast<int>(8 * u), 7),
                  std::min(static_cast<int>(8 * v), 7));
}

inline std::string SkyFile() {
  static const TemporaryFolder folder;
  std::vector<ExrPlane> planes = {{"R", {}, true}, {"G", {}, true}, {"B", {}, true}};
  for (int i = 0; i < 64; ++i) {
    for (int c = 0; c < 3; ++c) {
      planes[static_cast<std::size_t>(c)].values.push_back(
          static_cast<float>(SkyTexel(i % 8, i / 8)[c]));
    }
  }
  WriteExr(folder.File("sky.exr"), 8, 8, planes);
  return folder.File("sky.exr");
}

// Skies, constant, as an image and through a skylight, with a sun of their own and one
// that is a small, far, bright sphere.
inline SceneDescription SkyAndSun() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  const Index ground = b.AddDiffuse({0.5, 0.4, 0.3});
  Material leaf;
  leaf.kind = MaterialKind::kDiffuseTransmission;
  leaf.reflectance.constant = {0.4, 0.3, 0.2};
  leaf.transmittance.constant = {0.2, 0.3, 0.5};
  Material plastic;
  plastic.kind = MaterialKind::kCoatedDiffuse;
  // Grey: a coloured base under a coat is replaced when compiling by the colour of its
  // spectral response (src/scene/compile/coat.h), which the reference does not do.
  plastic.reflectance.constant = Grey(0.6);
  plastic.uroughness.constant = plastic.vroughness.constant = 0;
  b.AddPlane({0, 0, 0}, {0, 0, 1}, ground);
  b.AddQuad({-1, -0.5, 0.9}, {1, 0, 0.1}, {0, 1, 0}, b.AddMaterial(leaf));
  b.AddSphere({0.6, 0, 0.5}, 0.5, b.AddMaterial(plastic));
  b.AddSphere({4, 3, 8}, 1.5, ground, b.AddEmission({12, 11, 9}));
  b.AddDistant({-1, -1, 2}, {0.5, 0.5, 0.6});
  b.AddEnvironment({0.2, 0.3, 0.5});
  b.AddEnvironment({});
  SceneDescription scene = b.Build();
  scene.lights.back().image_path = SkyFile();
  scene.lights.push_back(scene.lights.back());
  scene.lights.back().portal = {{-1.5, -1.5, 2}, {-1.5, 1, 2}, {1, 1, 2}, {1, -1.5, 2}};
  scene.lights.back().image_scale = 2;
  return scene;
}

// Lights of every shape that has a place, some with an image, for the selection of
// lights.
inline SceneDescription ManyLights() {
  SceneBuilder b(8, 8);
  b.Depth(2).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  const Index ground = b.AddDiffuse({0.5, 0.4, 0.3}), dark = b.AddDiffuse(Grey(0));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, ground);
  for (int i = 0; i < 6; ++i) {
    const double x = 0.6 * i - 1.5;
    b.AddSphere({x, 1, 0.8}, 0.15, dark, b.AddEmission({4.0 + i, 3, 2}));
    b.AddDisk({x, 0.2, 1.2}, {0.2 * i - 0.5, 0, -1}, 0.15, dark,
              b.AddEmission({3, 5, 2.0 + i}, i % 2 == 0));
    b.AddQuad({x, -0.8, 1}, {0, 0.2, 0}, {0.2, 0, 0.05 * i}, dark,
              b.AddEmission({6, 6, 6}));
  }
  b.AddPoint({0, 0, 2}, {0.3, 0.3, 0.3});
  b.AddSpot({1, 0, 2}, {0, 0, 0}, {2, 2, 2}, 30, 10);
  SceneDescription scene = b.Build();
  const std::string picture = Picture("emitted.exr", 8, 8, Patchwork);
  for (std::size_t i = 0; i < 6; ++i) scene.area_lights[i].image_path = picture;
  for (const LightKind kind : {LightKind::kGoniometric, LightKind::kProjection}) {
    Light& light = scene.lights.emplace_back();
    light.kind = kind;
    light.image_path = picture;
    light.emission = {0.5, 0.5, 0.5};
    light.world_from_light =
        Transform::Translate({-0.5, 0, 2}) * Transform::Rotate(180, {1, 0.1, 0});
  }
  return scene;
}

struct HardScene {
  const char* name;
  SceneDescription scene;
  int tile;      // pixels per side that together see enough of rare events
  int cost = 1;  // time of a sample of the reference, in that of most scenes
};

inline constexpr std::size_t kScenes = 7;
inline std::vector<HardScene> HardScenes() {
  return {{"tiny light", TinyLight(), 8},       {"large light", LargeLight(), 4},
          {"glossy plates", GlossyPlates(), 8}, {"sky and sun", SkyAndSun(), 4},
          {"many lights", ManyLights(), 8, 4},  {"clouds", NestedSmoke(), 8, 2},
          {"lamps with holes", MixedLamps(), 8}};
}

}  // namespace lanelight::test::hard
