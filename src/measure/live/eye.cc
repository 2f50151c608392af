#include "src/measure/live/eye.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight::live {
namespace {

Transform WorldFromEye(const Eye& eye) {
  return Transform::LookAt(eye.position, eye.target, eye.up).Inverse();
}

double UnitOf(const Camera& camera) {
  return Length(camera.world_from_camera.Vector({0, 0, 1}));
}

bool IsFinite(Vec3d v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void CheckEye(const Eye& eye) {
  const Vec3d forward = eye.target - eye.position;
  if (!IsFinite(eye.position) || !IsFinite(eye.target) || !IsFinite(eye.up) ||
      !(Length(forward) > 0)) {
    throw InputError(
        "the camera's position, target and up must be finite, and the "
        "target another point than the position");
  }
  const double sine = Length(Cross(forward, eye.up)) / Length(forward) / Length(eye.up);
  if (!(sine > 1e-6)) {
    throw InputError("the camera's up must not be along its line of sight");
  }
  if (!(eye.fov > 0 && eye.fov < 180)) {
    throw InputError(fmt::format(
        "a field of view of {} degrees; it must be above 0 and below 180", eye.fov));
  }
  if (!(eye.lens >= 0 && std::isfinite(eye.lens))) {
    throw InputError(fmt::format("a lens of radius {}; it must be 0 or more", eye.lens));
  }
  if (!(eye.focus > 0 && std::isfinite(eye.focus))) {
    throw InputError(
        fmt::format("a focus at a distance of {}; it must be above 0", eye.focus));
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

Eye EyeOf(const Camera& camera, double distance) {
  const Transform& t = camera.world_from_camera;
  const double unit = UnitOf(camera);
  Eye eye;
  eye.position = t.Point({0, 0, 0});
  eye.target = eye.position + t.Vector({0, 0, 1}) / unit * distance;
  eye.up = Normalize(t.Vector({0, 1, 0}));
  eye.fov = camera.fov;
  eye.lens = camera.lens_radius * unit;
  eye.focus = camera.focal_distance * unit;
  return eye;
}

Camera MovedCamera(const Camera& camera, const Eye& from, const Eye& to) {
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

nlohmann::json ToJson(const Eye& eye) {
  return {{"position", ArrayOf(eye.position)},
          {"target", ArrayOf(eye.target)},
          {"up", ArrayOf(eye.up)},
          {"fov", eye.fov},
          {"lens", eye.lens},
          {"focus", eye.focus}};
}

Eye EyeFromJson(const nlohmann::json& json) {
  Eye eye;
  eye.position = VectorOf(json.at("position"));
  eye.target = VectorOf(json.at("target"));
  eye.up = VectorOf(json.at("up"));
  eye.fov = json.at("fov").get<double>();
  eye.lens = json.at("lens").get<double>();
  eye.focus = json.at("focus").get<double>();
  CheckEye(eye);
  return eye;
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
