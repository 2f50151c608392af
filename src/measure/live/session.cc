#include "src/measure/live/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/suggest.h"
#include "src/base/image/image.h"
#include "src/measure/live/state_json.h"
#include "src/render/job/loaded_scene.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight::live {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

// Without a move for so long, the camera stands.
constexpr auto kCameraSettleTime = std::chrono::milliseconds(120);
// Memory for strategies that a page has left, so that returning to one renders nothing
// again.
constexpr std::size_t kMaxKeptBytes = std::size_t{256} << 20;

int IndexOf(const json& message, const char* member, int max_index) {
  const double value = message.at(member).get<double>();
  if (!(value >= 0 && value <= max_index) || value != std::floor(value)) {
    throw InputError(fmt::format("\"{}\" is {}; it must be a number from 0 to {}", member,
                                 value, max_index));
  }
  return static_cast<int>(value);
}

Pace PaceOf(const std::string& name) {
  if (name == "time") return Pace::kTime;
  if (name == "samples") return Pace::kSamples;
  ThrowUnknown({}, "pace", name, {"time", "samples"});
}

}  // namespace

Session::Session(const LiveScene& live_scene, std::string command, Send send)
    : live_scene_(live_scene),
      command_(std::move(command)),
      send_(std::move(send)),
      pose_(live_scene.pose),
      began_(Clock::now()),
      settled_(began_) {
  send_(HelloText(live_scene_), false);
}

void Session::Do(const json& message) {
  try {
    HandleCommand(message.at("do"), message);
  } catch (const json::exception& error) {
    throw UnknownMessageText(error);
  }
}

void Session::HandleCommand(const std::string& what, const json& m) {
  if (what == "camera") return Move(CameraPoseFromJson(m.at("eye")));
  if (what == "strategy") return Choose(IndexOf(m, "slot", kSlots - 1), m.at("name"));
  if (what == "exr") return SendExr(IndexOf(m, "slot", kSlots - 1));
  if (what == "ask") {
    return SendPixel(IndexOf(m, "x", kMaxImageSide - 1),
                     IndexOf(m, "y", kMaxImageSide - 1));
  }
  if (what == "camera-text") {
    return SendText("camera-text", PbrtText(MakeView(live_scene_, pose_, 1).described));
  }
  if (what == "pace") {
    pace_ = PaceOf(m.at("by"));
  } else if (what == "pause") {
    paused_ = m.at("on").get<bool>();
  } else if (what == "layer") {
    layer_ = LayerNamed(m.at("name"));
    for (Slot& slot : slots_) slot.sent = {};
  } else if (what == "seen") {
    const auto seen = static_cast<std::size_t>(IndexOf(m, "what", kSlots));
    (seen < kSlots ? slots_[seen].drawn : state_drawn_) = true;
  } else {
    ThrowUnknown({}, "command", what,
                 {"camera", "strategy", "pace", "pause", "layer", "ask", "seen", "exr",
                  "camera-text"});
  }
}

void Session::Move(const CameraPose& pose) {
  if (pose == pose_) return;
  MakeView(live_scene_, pose, 1);  // throws if there is no such camera
  pose_ = pose;
  ++view_;
  others_.clear();
  for (Slot& slot : slots_) {
    slot.renderer.reset();
    slot.previewed = false;
  }
  began_ = Clock::now();
  settled_ = began_ + kCameraSettleTime;
}

void Session::Choose(int index, const std::string& name) {
  Slot& slot = slots_[static_cast<std::size_t>(index)];
  if (slot.renderer) others_.push_back(std::move(slot.renderer));
  DropOldRenders();
  const double rate = slot.preview_rate;
  slot = {};
  slot.preview_rate = rate;
  slot.name = name;
  began_ = Clock::now();
  if (name.empty()) return;
  try {
    const Strategy own = live_scene_.job.loaded->description.strategy;
    slot.strategy = StrategyNamed(name, {}, own);
    slot.renderer = Make(index);
  } catch (const InputError& error) {
    Refuse(index, error.message());
  }
}

void Session::DropOldRenders() {
  std::size_t bytes = 0;
  for (const auto& other : others_) bytes += other->Bytes();
  while (!others_.empty() && bytes > kMaxKeptBytes) {
    bytes -= others_.front()->Bytes();
    others_.erase(others_.begin());
  }
}

// The one that was put aside, if there is one. Both slots may have the same.
std::shared_ptr<PassRenderer> Session::Make(int slot) {
  const Strategy& strategy = *slots_[static_cast<std::size_t>(slot)].strategy;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (!(others_[i]->strategy() == strategy)) continue;
    const auto found = others_[i];
    others_.erase(others_.begin() + static_cast<std::ptrdiff_t>(i));
    return found;
  }
  for (const Slot& other : slots_) {
    if (other.renderer && other.renderer->strategy() == strategy) return other.renderer;
  }
  return std::make_shared<PassRenderer>(live_scene_, MakeView(live_scene_, pose_, 1),
                                        strategy);
}

void Session::Refuse(int index, const std::string& why) {
  Slot& slot = slots_[static_cast<std::size_t>(index)];
  slot.renderer.reset();
  slot.strategy.reset();
  slot.refused = why;
}

}  // namespace lanelight::live
