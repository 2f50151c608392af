#include "src/measure/live/commands.h"

#include <fmt/format.h>

#include "src/base/core/json_text.h"

namespace lanelight::live {

nlohmann::json ParseMessage(std::string_view text) {
  if (text.size() > kLongestMessage) {
    throw InputError(fmt::format("a message of {} bytes; at most {} are taken",
                                 text.size(), kLongestMessage));
  }
  try {
    nlohmann::json message = ParseJson(text);
    message.at("do").get_ref<const std::string&>();
    return message;
  } catch (const nlohmann::json::exception& error) {
    throw NotUnderstood(error);
  }
}

InputError NotUnderstood(const nlohmann::json::exception& error) {
  return InputError("the message is not understood: " + JsonProblem(error));
}

bool ChangesWork(const nlohmann::json& message) {
  const std::string& what = message.at("do").get_ref<const std::string&>();
  return what == "camera" || what == "strategy" || what == "pace" || what == "pause";
}

}  // namespace lanelight::live
