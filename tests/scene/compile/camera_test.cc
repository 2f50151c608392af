#include "src/scene/compile/camera.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

Film FilmOf(int width, int height) {
  Film film;
  film.width = width;
  film.height = height;
  return film;
}

// Scene-space direction (perspective) or origin (orthographic) of a film position.
Vec3d Apply(const CompiledCamera& c, double x, double y) {
  const auto at = [&](float base, float dx, float dy) { return base + x * dx + y * dy; };
  const double a = at(c.base.x, c.dx.x, c.dy.x), b = at(c.base.y, c.dx.y, c.dy.y);
  const double z = at(c.base.z, c.dx.z, c.dy.z);
  const auto d = [](Vec3f v) { return VecCast<double>(v); };
  const Vec3d v = d(c.right) * a + d(c.up) * b + d(c.forward) * z;
  return c.kind == CameraKind::kPerspective ? v : d(c.origin) + v;
}

bool Near(Vec3d a, Vec3d b) { return Length(a - b) < 1e-5; }

TEST_CASE("compile: perspective camera", "[scene][compile]") {
  Camera camera;  // at the origin, looking along +z, 90 degrees
  const CompiledCamera c = CompileCamera(camera, FilmOf(200, 100), {});
  CHECK(Near(Apply(c, 100, 50), {0, 0, 1}));
  CHECK(Near(Apply(c, 0, 0), {-2, 1, 1}));  // top left; the shorter axis spans fov
  CHECK(Near(Apply(c, 200, 100), {2, -1, 1}));
  camera.fov = 60;
  const CompiledCamera narrow = CompileCamera(camera, FilmOf(100, 200), {});
  const double t = std::tan(std::numbers::pi / 6);
  CHECK(Near(Apply(narrow, 0, 0), {-t, 2 * t, 1}));
  camera.frame_aspect = 1;
  CHECK(Near(Apply(CompileCamera(camera, FilmOf(100, 200), {}), 0, 0), {-t, t, 1}));
  const double window[4] = {0, 1, -1, 3};
  std::copy(window, window + 4, camera.screen_window);
  const CompiledCamera shifted = CompileCamera(camera, FilmOf(100, 200), {});
  CHECK(Near(Apply(shifted, 0, 0), {0, 3 * t, 1}));
  CHECK(Near(Apply(shifted, 100, 200), {t, -t, 1}));
}

TEST_CASE("compile: mirrored and scaled cameras", "[scene][compile]") {
  Camera camera;
  camera.lens_radius = 0.1;
  camera.focal_distance = 10;
  // pbrt: "Scale -1 1 1" before LookAt.
  camera.world_from_camera =
      (Transform::Scale({-1, 1, 1}) * Transform::LookAt({1, 2, 3}, {1, 2, 13}, {0, 1, 0}))
          .Inverse();
  const WorldFrame frame{{1, 0, 0}, 4};
  const CompiledCamera c = CompileCamera(camera, FilmOf(100, 100), frame);
  CHECK(Near(Apply(c, 0, 0), {1, 1, 1}));
  CHECK(c.origin == Vec3f{0, 8, 12});
  CHECK(c.lens_radius == 0.4f);
  CHECK(c.focal_distance == 40.0f);
  // Scaling the camera scales its lens; the axes stay unit.
  camera.world_from_camera = camera.world_from_camera * Transform::Scale({3, 3, 3});
  const CompiledCamera scaled = CompileCamera(camera, FilmOf(100, 100), frame);
  CHECK(Near(Apply(scaled, 0, 0), {1, 1, 1}));
  CHECK(scaled.lens_radius == 1.2f);
  CHECK(Length(scaled.right) == Approx(1));
  // A stretched camera sees a stretched image.
  camera.world_from_camera = Transform::Scale({2, 1, 1});
  CHECK(Near(Apply(CompileCamera(camera, FilmOf(100, 100), {}), 0, 0), {-2, 1, 1}));
}

TEST_CASE("compile: orthographic camera", "[scene][compile]") {
  Camera camera;
  camera.kind = CameraKind::kOrthographic;
  camera.world_from_camera =
      Transform::Translate({0, 0, -5}) * Transform::Scale({3, 3, 3});
  const WorldFrame frame{{0, 0, 1}, 0.5};
  const CompiledCamera c = CompileCamera(camera, FilmOf(200, 100), frame);
  CHECK(Near(Apply(c, 100, 50), {0, 0, -3}));
  CHECK(Near(Apply(c, 0, 0), {-3, 1.5, -3}));  // (-2, 1) * 3 * 0.5
  CHECK(Near(VecCast<double>(c.forward), {0, 0, 1}));
}

TEST_CASE("compile: impossible cameras are refused", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.camera.where = At(2);
  d.camera.fov = 180;
  CHECK(CompileError(d).find("scene.pbrt:2:1: error: field of view 180") == 0);
  d.camera.fov = 50;
  d.camera.world_from_camera = Transform::Scale({1, 0, 1});
  CHECK(CompileError(d).find("singular") != std::string::npos);
  d.camera.world_from_camera = Transform();
  d.camera.screen_window[0] = d.camera.screen_window[1] = 1;
  d.camera.screen_window[3] = 1;
  CHECK(CompileError(d).find("empty screen window") != std::string::npos);
}

}  // namespace
}  // namespace lanelight
