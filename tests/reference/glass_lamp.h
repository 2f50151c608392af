// A lamp in the middle of a ball of glass, over a floor.
#pragma once

#include "tests/reference/light_path_images.h"
#include "tests/reference/scenes.h"

namespace lanelight::test::bidirectional {

inline constexpr double kLampRadius = 0.2, kBallRadius = 0.5, kIndex = 1.5;
inline constexpr Rgb kLampRadiance = {40, 30, 20}, kFloor = {0.7, 0.5, 0.3};

inline SceneDescription LampInGlass(Vec3d eye, double fov) {
  SceneBuilder b(kSide, kSide);
  b.Depth(2).Perspective(eye, {eye.x, 0, 0}, {0, 1, 0}, fov);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(kFloor));
  b.AddSphere({0, 0, 1}, kBallRadius, b.AddDielectric(kIndex));
  b.AddSphere({0, 0, 1}, kLampRadius, b.AddDiffuse(Grey(0)),
              b.AddEmission(kLampRadiance));
  return b.Build();
}

}  // namespace lanelight::test::bidirectional
