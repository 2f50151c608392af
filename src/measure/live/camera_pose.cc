#include "src/measure/live/camera_pose.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/core/transform.h"
#include "src/scene/description/description.h"
#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight::live {
namespace {

Transform WorldFromEye(const CameraPose& pose) {
  return Transform::LookAt(pose.position, pose.target, pose.up).Inverse();
}

double UnitOf(const Camera& camera) {
  return Length(camera.world_from_camera.Vector({0, 0, 1}));
}

bool IsFinite(Vec3d v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void CheckEye(const CameraPose& pose) {
  const Vec3d forward = pose.target - pose.position;
  if (!IsFinite(pose.position) || !IsFinite(pose.target) || !IsFinite(pose.up) ||
      !(Length(forward) > 0)) {
    throw InputError(
        "the camera's position, target and up must be finite, and the "
        "target another point than the position");
  }
  const double sine = Length(Cross(forward, pose.up)) / Length(forward) / Length(pose.up);
  if (!(sine > 1e-6)) {
    throw InputError("the camera's up must not be along its line of sight");
  }
  if (!(pose.fov > 0 && pose.fov < 180)) {
    throw InputError(fmt::format(
        "a field of view of {} degrees; it must be above 0 and below 180", pose.fov));
  }
  if (!(pose.lens >= 0 && std::isfinite(pose.lens))) {
    throw InputError(fmt::format("a lens of radius {}; it must be 0 or more", pose.lens));
  }
  if (!(pose.focus > 0 && std::isfinite(pose.focus))) {
    throw InputError(
        fmt::format("a focus at a distance of {}; it must be above 0", pose.focus));
  }
}

std::string TransformText(const Transform& t) {
  std::string text = "Transform [";
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) text += fmt::format(" {}", t(row, column));
  }
  return text + " ]\n";
}

nlohmann::json ArrayOf(Vec3d v) { return {v.x, v.y, v.z}; }
Vec3d VectorOf(const nlohmann::json& json) {
  const auto v = json.get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

}  // namespace

CameraPose PoseOf(const Camera& camera, double distance) {
  const Transform& t = camera.world_from_camera;
  const double unit = UnitOf(camera);
  CameraPose pose;
  pose.position = t.Point({0, 0, 0});
  pose.target = pose.position + t.Vector({0, 0, 1}) / unit * distance;
  pose.up = Normalize(t.Vector({0, 1, 0}));
  pose.fov = camera.fov;
  pose.lens = camera.lens_radius * unit;
  pose.focus = camera.focal_distance * unit;
  return pose;
}

Camera MovedCamera(const Camera& camera, const CameraPose& from, const CameraPose& to) {
  CheckEye(to);
  if (from == to) return camera;
  Camera moved = camera;
  const Transform move = WorldFromEye(to) * WorldFromEye(from).Inverse();
  moved.world_from_camera = move * camera.world_from_camera;
  if (camera.end) moved.end = std::make_shared<const Transform>(move * *camera.end);
  const double unit = UnitOf(camera);
  if (camera.kind == CameraKind::kPerspective) moved.fov = to.fov;
  if (to.lens != from.lens) moved.lens_radius = to.lens / unit;
  if (to.focus != from.focus) moved.focal_distance = to.focus / unit;
  return moved;
}

nlohmann::json ToJson(const CameraPose& pose) {
  return {{"position", ArrayOf(pose.position)},
          {"target", ArrayOf(pose.target)},
          {"up", ArrayOf(pose.up)},
          {"fov", pose.fov},
          {"lens", pose.lens},
          {"focus", pose.focus}};
}

CameraPose CameraPoseFromJson(const nlohmann::json& json) {
  CameraPose pose;
  pose.position = VectorOf(json.at("position"));
  pose.target = VectorOf(json.at("target"));
  pose.up = VectorOf(json.at("up"));
  pose.fov = json.at("fov").get<double>();
  pose.lens = json.at("lens").get<double>();
  pose.focus = json.at("focus").get<double>();
  CheckEye(pose);
  return pose;
}

std::string PbrtText(const Camera& camera) {
  std::string text = TransformText(camera.world_from_camera.Inverse());
  if (camera.end) {
    text += "ActiveTransform EndTime\n" + TransformText(camera.end->Inverse()) +
            "ActiveTransform All\n";
  }
  if (camera.kind == CameraKind::kRealistic || camera.kind == CameraKind::kSpherical) {
    return text + "# and the Camera directive as it is in the file\n";
  }
  const bool perspective = camera.kind == CameraKind::kPerspective;
  text += fmt::format("Camera \"{}\"", perspective ? "perspective" : "orthographic");
  if (perspective) text += fmt::format(" \"float fov\" [ {} ]", camera.fov);
  text += fmt::format(" \"float lensradius\" [ {} ] \"float focaldistance\" [ {} ]",
                      camera.lens_radius, camera.focal_distance);
  if (camera.frame_aspect > 0) {
    text += fmt::format(" \"float frameaspectratio\" [ {} ]", camera.frame_aspect);
  }
  const double* w = camera.screen_window;
  if (w[0] != 0 || w[1] != 0 || w[2] != 0 || w[3] != 0) {
    text +=
        fmt::format(" \"float screenwindow\" [ {} {} {} {} ]", w[0], w[1], w[2], w[3]);
  }
  return text + "\n";
}

}  // namespace lanelight::live
