// Messages between the server and a page: JSON objects with a member "do" from the page
// (Session::Do); the scene, its strategies and the progress from the server.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "src/base/core/error.h"
#include "src/measure/live/pass_renderer.h"
#include "src/measure/live/score.h"

namespace lanelight::live {

inline constexpr int kSlots = 2;  // A and B

/// Bytes of a message, at most.
inline constexpr std::size_t kLongestMessage = 1u << 14;

/// Reads a JSON object whose member "do" is a text. Throws InputError.
nlohmann::json ParseMessage(std::string_view text);

/// Returns an InputError that says what is wrong with a message.
InputError UnknownMessageText(const nlohmann::json::exception& error);

/// Returns whether the message may make the work in progress obsolete.
bool ChangesWork(const nlohmann::json& message);

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
