// The camera that a page moves.
#include "src/measure/live/camera_pose.h"

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

TEST_CASE("a pose is the camera's position in units of the scene", "[live]") {
  const CameraPose pose = PoseOf(OddCamera(), 5);
  CHECK(Length(pose.position - Vec3d{1, 2, 3}) < 1e-12);
  CHECK(Length(pose.target - pose.position) == Approx(5));
  CHECK(pose.lens == Approx(0.05));
  CHECK(pose.focus == Approx(3));
}

TEST_CASE("an unmoved camera is bit-identical, and a moved one keeps its mirroring",
          "[live]") {
  const Camera camera = OddCamera();
  const CameraPose pose = PoseOf(camera, 5);
  CHECK(MovedCamera(camera, pose, pose).world_from_camera == camera.world_from_camera);
  CameraPose moved = pose;
  moved.position = {7, 8, 9};
  moved.fov = 50;
  moved.focus = 4;
  const Camera other = MovedCamera(camera, pose, moved);
  CHECK(other.world_from_camera.SwapsHandedness() ==
        camera.world_from_camera.SwapsHandedness());
  CHECK(other.fov == 50);
  CHECK(other.lens_radius == camera.lens_radius);
  CHECK(other.focal_distance == Approx(8));
  const CameraPose seen = PoseOf(other, Length(moved.target - moved.position));
  CHECK(Length(seen.position - moved.position) < 1e-12);
  CHECK(Length(seen.target - moved.target) < 1e-12);
  // And back.
  CheckNear(MovedCamera(other, moved, pose).world_from_camera, camera.world_from_camera);
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

TEST_CASE("camera poses in JSON, and invalid ones", "[live]") {
  const CameraPose pose = PoseOf(OddCamera(), 5);
  CHECK(CameraPoseFromJson(ToJson(pose)) == pose);
  const auto refused = [&](const char* member, const nlohmann::json& value) {
    nlohmann::json json = ToJson(pose);
    json[member] = value;
    INFO(member);
    CHECK_THROWS_AS(CameraPoseFromJson(json), InputError);
  };
  refused("target", ToJson(pose)["position"]);
  refused("up", {0, 0, 0});
  const Vec3d ahead = pose.target - pose.position;
  refused("up", {ahead.x, ahead.y, ahead.z});
  refused("position", {std::numeric_limits<double>::infinity(), 0, 0});
  refused("fov", 180);
  refused("fov", 0);
  refused("lens", -1);
  refused("focus", 0);
  nlohmann::json lacking = ToJson(pose);
  lacking.erase("up");
  CHECK_THROWS_AS(CameraPoseFromJson(lacking), nlohmann::json::exception);
}

TEST_CASE("a reduced view shows the same image as the full view", "[live]") {
  const LiveScene live_scene = SmallLiveScene(33, 24);
  const View whole = MakeView(live_scene, live_scene.pose, 1),
             half = MakeView(live_scene, live_scene.pose, 2);
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
