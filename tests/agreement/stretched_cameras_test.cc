// Cameras under transforms that stretch, shear and mirror.
#include <catch2/catch.hpp>

#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

// Lamps that have their places in the space of the camera: whatever its transform, the
// image is the same.
SceneDescription Lamps(CameraKind kind, const Transform& world_from_camera) {
  SceneBuilder b(8, 6);
  b.Depth(0);
  Camera& camera = b.scene().camera;
  camera.kind = kind;
  camera.fov = 50;
  camera.lens_radius = kind == CameraKind::kSpherical ? 0 : 0.2;
  camera.focal_distance = 3;
  if (kind == CameraKind::kRealistic) {
    camera.lens = {55, 7, 1.517, 28, -48, 3, 1.62, 28, -180, 4, 1, 27, 0, 72, 0, 24};
    camera.aperture_diameter = 20;
    camera.film_diagonal = 43;
  }
  camera.world_from_camera = world_from_camera;
  const Index black = b.AddDiffuse(Grey(0));
  const auto lamp = [&](Vec3d corner, Vec3d u, Vec3d v, Rgb color) {
    AreaLight light;
    light.radiance = color;
    light.two_sided = true;
    b.scene().area_lights.push_back(light);
    b.AddQuad(world_from_camera.Point(corner), world_from_camera.Vector(u),
              world_from_camera.Vector(v), black,
              static_cast<Index>(b.scene().area_lights.size() - 1));
  };
  lamp({-0.8, -0.3, 2}, {1, 0.2, 0}, {0, 0.7, 0.4}, {3, 1, 0.5});
  lamp({0.1, -1.2, 4}, {1.5, 0, 0.3}, {0.2, 2, 0}, {0.3, 2, 1});
  return b.Build();
}

}  // namespace

TEST_CASE("a scene transformed with its camera renders the same image",
          "[generate][agreement]") {
  const Transform::Matrix shear{
      {{1, 0.4, 0, 0.3}, {0, 1, -0.3, 1}, {0.2, 0, 1, 0}, {0, 0, 0, 1}}};
  const Transform stretches[] = {
      Transform::Scale({1.3, 0.5, 2}), Transform(shear), Transform::Scale({-1, 1, 1}),
      Transform::Rotate(30, {1, 2, 0}) * Transform::Scale({0.6, 2, -0.8})};
  for (const CameraKind kind : {CameraKind::kPerspective, CameraKind::kOrthographic,
                                CameraKind::kSpherical, CameraKind::kRealistic}) {
    const auto plain = RenderWavefront(Lamps(kind, Transform()), 16384);
    for (const Transform& stretch : stretches) {
      stat::CheckSame(stat::CompareMeans(RenderWavefront(Lamps(kind, stretch), 16384),
                                         plain, {4, 1e-6, 1e-3, 1e-6}),
                      0.2, fmt::format("camera {}", static_cast<int>(kind)));
    }
  }
}

}  // namespace lanelight::test
