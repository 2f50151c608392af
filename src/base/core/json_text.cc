#include "src/base/core/json_text.h"

#include <fmt/format.h>

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr int kTooDeep = 599;  // a number that nlohmann's own errors do not have

}  // namespace

std::string DumpJson(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json ParseJson(std::string_view text) {
  using Event = Json::parse_event_t;
  return Json::parse(text, [](int depth, Event event, const Json&) {
    const bool opens = event == Event::array_start || event == Event::object_start;
    if (opens && depth >= kDeepestJson) {
      throw Json::other_error::create(kTooDeep, "", nullptr);
    }
    return true;
  });
}

std::string JsonProblem(const Json::exception& error) {
  if (error.id == kTooDeep) {
    return fmt::format("values are nested more than {} deep", kDeepestJson);
  }
  if (const auto* parse = dynamic_cast<const Json::parse_error*>(&error)) {
    return fmt::format("invalid JSON at byte {}", parse->byte);
  }
  return "a value is missing, or is of another type than this program writes";
}

}  // namespace lanelight
