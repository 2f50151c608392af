// light-paths=splats against closed forms.
#include <catch2/catch.hpp>
#include <numbers>

#include "tests/reference/camera.h"
#include "tests/reference/closed_forms.h"
#include "tests/reference/glass_lamp.h"
#include "tests/reference/light_path_images.h"
#include "tests/reference/scenes.h"

namespace lanelight::test::bidirectional {
namespace {

// Rays that pass the centre at the distance h < index * radius of the lamp meet it at the
// distance h / index. Their radiance is that of the lamp times (1 - R) / index^2.
Rgb LampInGlassOnFloor(Vec3d p) {
  constexpr int kSteps = 200;
  const double reach = kIndex * kLampRadius;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = reach * (i + 0.5) / kSteps, sine = h / kBallRadius;
    const double passes = 1 - closed_form::Fresnel(std::sqrt(1 - sine * sine), kIndex);
    sum += passes / (kIndex * kIndex) * h * reach / kSteps;
  }
  const Vec3d to = Vec3d{0, 0, 1} - p;
  const double d2 = Dot(to, to), cosine = to.z / std::sqrt(d2);
  return kFloor * kLampRadiance * (2 * sum * cosine / d2);
}

// A lamp that faces the floor, beside a mirror that reflects it.
const std::vector<Vec3d> kLamp = {
    {0.2, -0.1, 0.9}, {0.2, 0.1, 0.9}, {0.4, 0.1, 0.9}, {0.4, -0.1, 0.9}};
constexpr double kMirror = 1.2;

SceneDescription LampAndMirror() {
  SceneBuilder b(kSide, kSide);
  b.Depth(2).Perspective({0.8, 0, 4}, {0.8, 0, 0}, {0, 1, 0}, 9);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(kFloor));
  b.AddQuad(kLamp[0], kLamp[1] - kLamp[0], kLamp[3] - kLamp[0], b.AddDiffuse(Grey(0)),
            b.AddEmission(kLampRadiance));
  b.AddQuad({kMirror, -3, 0}, {0, 6, 0}, {0, 0, 3},
            b.AddConductor(Grey(1e-3), Grey(1e4)));
  return b.Build();
}

Rgb LampAndMirrorOnFloor(Vec3d p) {
  std::vector<Vec3d> image = kLamp;
  for (Vec3d& corner : image) corner.x = 2 * kMirror - corner.x;
  const Vec3d up = {0, 0, 1};
  return kFloor * kLampRadiance *
         ((closed_form::PolygonIrradiance(1, kLamp, p, up) +
           closed_form::PolygonIrradiance(1, image, p, up)) /
          std::numbers::pi);
}

// The mean over the filter of each pixel of a function of points on the floor z = 0.
Renders OnFloor(const SceneDescription& scene, const std::function<Rgb(Vec3d)>& f) {
  constexpr int kSub = 6;
  const reference::CameraRays camera(scene.camera, scene.film);
  reference::Random unused(1);
  std::vector<Rgb> image;
  for (int pixel = 0; pixel < kSide * kSide; ++pixel) {
    Rgb sum;
    for (int i = 0; i < kSub * kSub; ++i) {
      const double u = 2 * (i % kSub + 0.5) / kSub - 1;
      const double v = 2 * (i / kSub + 0.5) / kSub - 1;
      const double x = pixel % kSide + 0.5 + u * scene.filter.x_radius;
      const double y = pixel / kSide + 0.5 + v * scene.filter.y_radius;
      const reference::Ray ray = camera.Sample(x, y, unused).ray;
      sum += f(ray.o - ray.d * (ray.o.z / ray.d.z));
    }
    image.push_back(sum / (kSub * kSub));
  }
  return Renders(2, Image(image));
}

}  // namespace

TEST_CASE("splats: light that leaves a glass ball has a closed form", "[light_paths]") {
  const SceneDescription scene = LampInGlass({1.4, 0, 0.8}, 60);
  CheckSame(Compare(RenderParts(scene, 2048, 1).all, OnFloor(scene, LampInGlassOnFloor)),
            0.03, "floor");
}

TEST_CASE("splats: light of a lamp and its mirror image has a closed form",
          "[light_paths]") {
  const SceneDescription scene = LampAndMirror();
  CheckSame(
      Compare(RenderParts(scene, 1024, 1).all, OnFloor(scene, LampAndMirrorOnFloor)),
      0.03, "floor");
}

// More events than light subpaths have vertices.
TEST_CASE("splats: closed rooms have closed forms", "[light_paths]") {
  constexpr int kDepth = 11;
  constexpr double kAlbedo = 0.9;
  for (SceneDescription scene :
       {ClosedRoom(kAlbedo, kDepth), ClosedBox(kAlbedo, kDepth)}) {
    scene.film.width = scene.film.height = kSide;
    const double light = closed_form::ClosedRoom(1, kAlbedo, kDepth);
    const Renders expected(2, Image(std::vector<Rgb>(kSide * kSide, Grey(light))));
    CheckSame(Compare(RenderParts(scene, 64, 1).all, expected), 0.02, "room");
  }
}

}  // namespace lanelight::test::bidirectional
