// JSON as text: the one way out, for names of any bytes, and the one way in, for files
// that may be damaged or malicious.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "src/base/core/error.h"

namespace lanelight {

/// Arrays and objects in each other: our files have about six.
inline constexpr int kDeepestJson = 64;

/// In one line, or indented. Names of files and of things in scenes are bytes: what of
/// them is not UTF-8 becomes U+FFFD.
std::string DumpJson(const nlohmann::json& json, int indent = -1);

/// Throws nlohmann::json::exception where the text is not JSON, or is deeper than
/// kDeepestJson: copies and comparisons of values take a call in a call for each level.
nlohmann::json ParseJson(std::string_view text);

/// What is wrong with JSON that was read, in our words: its text, or what it lacks.
std::string JsonProblem(const nlohmann::json::exception& error);

/// read(), which takes values out of the JSON of a file. Throws InputError, which names
/// `path`, where it is not the JSON that is expected.
template <class Read>
auto FromJsonOf(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("'{}' is damaged: {}", path, JsonProblem(error)));
  }
}

}  // namespace lanelight
