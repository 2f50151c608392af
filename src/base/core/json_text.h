// Writes JSON with strings of any bytes, and reads JSON of files that may be damaged or
// malicious.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "src/base/core/error.h"

namespace lanelight {

/// Largest nesting of arrays and objects; files of this program have about six levels.
inline constexpr int kDeepestJson = 64;

/// Writes one line, or indented lines. Bytes that are not UTF-8 become U+FFFD.
std::string DumpJson(const nlohmann::json& json, int indent = -1);

/// Throws nlohmann::json::exception where the text is not JSON, or is deeper than
/// kDeepestJson: copies and comparisons of values recurse once per level.
nlohmann::json ParseJson(std::string_view text);

/// Returns the cause of the exception in plain words.
std::string JsonProblem(const nlohmann::json::exception& error);

/// Returns read(), which converts the JSON of a file. Throws InputError that names `path`
/// for unexpected JSON.
template <class Read>
auto FromJsonOf(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    throw InputError("'{}' is damaged: {}", path, JsonProblem(error));
  }
}

}  // namespace lanelight
