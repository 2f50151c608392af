// What pages are told: the scene and its strategies at first, then how far they are.
#pragma once

#include <array>
#include <string>

#include "src/measure/live/commands.h"
#include "src/measure/live/pass_renderer.h"
#include "src/measure/live/score.h"

namespace lanelight::live {

struct StateOfSlot {
  std::string name, refused;
  const PassRenderer* renderer = nullptr;  // null: nothing has been rendered
};
struct StateOfPage {
  const LiveScene& live_scene;
  const CameraPose& pose;
  std::uint64_t view = 0;
  Pace pace = Pace::kTime;
  bool paused = false;
  std::array<StateOfSlot, kSlots> slots;
};

/// "kind": "hello"; scene, size of the image, camera, what `lanelight strategies --json`
/// prints, layers.
std::string HelloText(const LiveScene& live_scene);

/// "kind": "state"; of each slot samples, times, errors with their intervals, stages and
/// what was left out; the ratio; the command line that renders this, which begins with
/// `command`.
std::string StateText(const StateOfPage& state, const std::string& command);

/// A message as EncodePicture's, with "kind": "file" and "name", then the file: the EXR
/// that `lanelight render` would write now.
std::string ExrMessage(const LiveScene& live_scene, const PassRenderer& renderer);

}  // namespace lanelight::live
