// The parts of a compiled scene that depend on the camera and on the size of the film.
// They are rebuilt when a page moves the camera; BVH, lights and textures are kept.
#pragma once

#include "src/measure/live/camera_pose.h"
#include "src/render/job/job.h"
#include "src/scene/compiled/view.h"
#include "src/scene/description/description.h"

namespace lanelight::live {

/// A scene that pages look at, compiled once.
struct LiveScene {
  std::string path;  // of the scene file
  Job job;
  CameraPose pose;  // of the scene's own camera

  /// Compiles the scene. Throws InputError as PrepareJob does.
  LiveScene(const std::string& scene, const RenderSettings& settings);
};

struct View : CompiledView {
  CameraPose pose;
  int factor = 1;  // one pixel of it stands for so many of the image in each direction
  Camera described;
  PixelRect window;
};

/// Throws InputError for an pose that cannot be.
View MakeView(const LiveScene& live_scene, const CameraPose& pose, int factor);

}  // namespace lanelight::live
