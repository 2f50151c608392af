// What errors say, as part of other messages.
#pragma once

#include <exception>
#include <string>

namespace lanelight {

/// The message without "error: " at its beginning: to be put into another one.
inline std::string WithoutPrefix(const std::exception& error) {
  const std::string text = error.what(), prefix = "error: ";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

/// The message with "error: " before it, unless it says so itself.
inline std::string WithPrefix(const std::exception& error) {
  const std::string text = error.what(), prefix = "error: ";
  return text.find(prefix) == text.npos ? prefix + text : text;
}

}  // namespace lanelight
