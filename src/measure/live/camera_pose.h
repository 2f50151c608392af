// Position, target and lens of the camera, which a page moves.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "src/base/core/vec.h"

namespace lanelight {
struct Camera;  // src/scene/description/description.h
}

namespace lanelight::live {

/// In the space and units of the scene file.
struct CameraPose {
  Vec3d position, target{0, 0, 1}, up{0, 1, 0};
  double fov = 90;   // degrees, of the shorter side; of perspective cameras
  double lens = 0;   // radius
  double focus = 1;  // distance that is sharp

  friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

/// That of a camera; it looks at the point that is `distance` in front of it.
CameraPose PoseOf(const Camera& camera, double distance);

/// The camera, moved as a rigid body from where `from` is to where `to` is, with the lens
/// of `to`. Mirrors and scales that the camera has stay. If both are equal, so are the
/// cameras, bit by bit. Throws InputError for an pose that cannot be.
Camera MovedCamera(const Camera& camera, const CameraPose& from, const CameraPose& to);

nlohmann::json ToJson(const CameraPose& pose);
/// Throws nlohmann::json::exception for what is missing or no number, InputError for a
/// place, direction or lens that cannot be.
CameraPose CameraPoseFromJson(const nlohmann::json& json);

/// The lines of pbrt-v4 that state this camera, to be put in the place of the file's own.
std::string PbrtText(const Camera& camera);

}  // namespace lanelight::live
