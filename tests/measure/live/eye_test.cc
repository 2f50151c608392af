// The camera that a page moves.
#include "src/measure/live/eye.h"

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/scene/parse/parse.h"
#include "tests/measure/live/live_scene.h"

namespace lanelight::live {
namespace {

// A mirrored and scaled camera, as exports have them.
Camera OddCamera() {
  Camera camera;
  camera.world_from_camera =
      (Transform::Scale({-2, 2, 2}) * Transform::LookAt({1, 2, 3}, {4, 2, 5}, {0, 1, 0}))
          .Inverse();
  camera.fov = 40;
  camera.lens_radius = 0.1;
  camera.focal_distance = 6;
  return camera;
}

void CheckNear(const Transform& a, const Transform& b) {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      CHECK(a(row, column) == Approx(b(row, column)).margin(1e-12));
    }
  }
}

Camera ParsedCamera(const std::string& lines) {
  return ParseSceneText("Film \"rgb\"\n" + lines + "WorldBegin\n", "text", {}).camera;
}

}  // namespace

TEST_CASE("an eye is where the camera is, in units of the scene", "[live]") {
  const Eye eye = EyeOf(OddCamera(), 5);
  CHECK(Length(eye.position - Vec3d{1, 2, 3}) < 1e-12);
  CHECK(Length(eye.target - eye.position) == Approx(5));
  CHECK(eye.lens == Approx(0.05));
  CHECK(eye.focus == Approx(3));
}

TEST_CASE("a camera that is not moved keeps its bits, and a moved one its mirror",
          "[live]") {
  const Camera camera = OddCamera();
  const Eye eye = EyeOf(camera, 5);
  CHECK(MovedCamera(camera, eye, eye).world_from_camera == camera.world_from_camera);
  Eye moved = eye;
  moved.position = {7, 8, 9};
  moved.fov = 50;
  moved.focus = 4;
  const Camera other = MovedCamera(camera, eye, moved);
  CHECK(other.world_from_camera.SwapsHandedness() ==
        camera.world_from_camera.SwapsHandedness());
  CHECK(other.fov == 50);
  CHECK(other.lens_radius == camera.lens_radius);
  CHECK(other.focal_distance == Approx(8));
  const Eye seen = EyeOf(other, Length(moved.target - moved.position));
  CHECK(Length(seen.position - moved.position) < 1e-12);
  CHECK(Length(seen.target - moved.target) < 1e-12);
  // And back.
  CheckNear(MovedCamera(other, moved, eye).world_from_camera, camera.world_from_camera);
}

TEST_CASE("the text of a camera is that camera again", "[live]") {
  Camera camera = OddCamera();
  camera.screen_window[0] = -1, camera.screen_window[1] = 1;
  camera.screen_window[2] = -0.5, camera.screen_window[3] = 0.5;
  camera.frame_aspect = 2;
  const Camera again = ParsedCamera(PbrtText(camera));
  CheckNear(again.world_from_camera, camera.world_from_camera);
  CHECK(again.fov == camera.fov);
  CHECK(again.lens_radius == camera.lens_radius);
  CHECK(again.focal_distance == camera.focal_distance);
  CHECK(again.frame_aspect == camera.frame_aspect);
  CHECK(again.screen_window[2] == camera.screen_window[2]);
  camera.kind = CameraKind::kOrthographic;
  CHECK(ParsedCamera(PbrtText(camera)).kind == CameraKind::kOrthographic);
}

TEST_CASE("eyes as JSON, and those that cannot be", "[live]") {
  const Eye eye = EyeOf(OddCamera(), 5);
  CHECK(EyeFromJson(ToJson(eye)) == eye);
  const auto refused = [&](const char* member, const nlohmann::json& value) {
    nlohmann::json json = ToJson(eye);
    json[member] = value;
    INFO(member);
    CHECK_THROWS_AS(EyeFromJson(json), InputError);
  };
  refused("target", ToJson(eye)["position"]);
  refused("up", {0, 0, 0});
  const Vec3d ahead = eye.target - eye.position;
  refused("up", {ahead.x, ahead.y, ahead.z});
  refused("position", {std::numeric_limits<double>::infinity(), 0, 0});
  refused("fov", 180);
  refused("fov", 0);
  refused("lens", -1);
  refused("focus", 0);
  nlohmann::json lacking = ToJson(eye);
  lacking.erase("up");
  CHECK_THROWS_AS(EyeFromJson(lacking), nlohmann::json::exception);
}

TEST_CASE("a reduced view shows what the whole one does", "[live]") {
  const Stage stage = SmallStage(33, 24);
  const View whole = MakeView(stage, stage.eye, 1), half = MakeView(stage, stage.eye, 2);
  CHECK(whole.film.width == 33);
  CHECK(half.film.width == 17);
  CHECK(half.film.height == 12);
  // The same corners of the screen.
  const Vec3f w = whole.camera.base + whole.camera.dx * 33.0f;
  const Vec3f h = half.camera.base + half.camera.dx * 17.0f;
  CHECK(w.x == Approx(h.x));
  CHECK(whole.camera.base.y == Approx(half.camera.base.y));
}

}  // namespace lanelight::live
