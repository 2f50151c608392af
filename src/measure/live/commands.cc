#include "src/measure/live/commands.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/core/suggest.h"
#include "src/base/image/image.h"

namespace lanelight::live {
namespace {

using nlohmann::json;

constexpr int kMostImageIndex = kMaxImageSide - 1;

int IndexOf(const json& message, const char* member, int most) {
  const double value = message.at(member).get<double>();
  if (!(value >= 0 && value <= most) || value != std::floor(value)) {
    throw InputError(fmt::format("\"{}\" is {}; it must be a number from 0 to {}", member,
                                 value, most));
  }
  return static_cast<int>(value);
}

Pace PaceOf(const std::string& name) {
  if (name == "time") return Pace::kTime;
  if (name == "samples") return Pace::kSamples;
  ThrowUnknown({}, "pace", name, {"time", "samples"});
}

Command CommandOf(const std::string& what, const json& m) {
  if (what == "camera") return MoveEye{EyeFromJson(m.at("eye"))};
  if (what == "strategy") {
    return ChooseStrategy{IndexOf(m, "slot", kSlots - 1), m.at("name")};
  }
  if (what == "pace") return ChoosePace{PaceOf(m.at("by"))};
  if (what == "pause") return Pause{m.at("on").get<bool>()};
  if (what == "layer") return ChooseLayer{LayerNamed(m.at("name"))};
  if (what == "ask")
    return Ask{IndexOf(m, "x", kMostImageIndex), IndexOf(m, "y", kMostImageIndex)};
  if (what == "seen") return Seen{IndexOf(m, "what", kSlots)};
  if (what == "exr") return SaveExr{IndexOf(m, "slot", kSlots - 1)};
  if (what == "camera-text") return TellCamera{};
  ThrowUnknown({}, "command", what,
               {"camera", "strategy", "pace", "pause", "layer", "ask", "seen", "exr",
                "camera-text"});
}

}  // namespace

Command ParseCommand(std::string_view text) {
  if (text.size() > kLongestMessage) {
    throw InputError(fmt::format("a message of {} bytes; at most {} are taken",
                                 text.size(), kLongestMessage));
  }
  try {
    const json message = ParseJson(text);
    return CommandOf(message.at("do").get<std::string>(), message);
  } catch (const json::exception& error) {
    throw InputError("the message is not understood: " + JsonProblem(error));
  }
}

bool ChangesWork(const Command& command) {
  return std::holds_alternative<MoveEye>(command) ||
         std::holds_alternative<ChooseStrategy>(command) ||
         std::holds_alternative<ChoosePace>(command) ||
         std::holds_alternative<Pause>(command);
}

}  // namespace lanelight::live
