// Errors in the user's input: they state the place and what would be right.
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace lanelight {

struct SourceLocation;  // src/base/core/source_location.h

/// A mistake in the input. what() is a complete message: place, what was found, what
/// is supported. With further arguments, the message is a format string for them.
class InputError : public std::runtime_error {
 public:
  InputError(const SourceLocation& where, const std::string& message);
  explicit InputError(const std::string& message);
  template <class... Args>
    requires(sizeof...(Args) > 0)
  InputError(const SourceLocation& where, fmt::format_string<Args...> format,
             Args&&... args)
      : InputError(where, fmt::format(format, std::forward<Args>(args)...)) {}
  template <class... Args>
    requires(sizeof...(Args) > 0)
  explicit InputError(fmt::format_string<Args...> format, Args&&... args)
      : InputError(fmt::format(format, std::forward<Args>(args)...)) {}

  /// Returns what is wrong, without the place.
  const char* message() const { return what() + place_; }

 private:
  std::size_t place_;  // length of the place in what()
};

/// Returns the message without "error: " at its beginning, to be quoted in another one.
inline std::string WithoutPrefix(const std::exception& error) {
  const std::string text = error.what(), prefix = "error: ";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

/// Returns the message, with "error: " before it unless it contains that.
inline std::string WithPrefix(const std::exception& error) {
  const std::string text = error.what(), prefix = "error: ";
  return text.find(prefix) == text.npos ? prefix + text : text;
}

}  // namespace lanelight
