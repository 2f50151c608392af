// Errors in what the user gave us: they carry a place and say what would be right.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace lanelight {

/// Where in the input something stands. Lines and columns count from 1; 0 = unknown.
struct SourceLocation {
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;

  /// "file:line:column", as far as known.
  std::string ToString() const {
    if (!file) return "<no file>";
    if (line == 0) return *file;
    return fmt::format("{}:{}:{}", *file, line, column);
  }
};

/// A mistake in the input. what() is a complete message: place, what was found, what
/// is supported.
class InputError : public std::runtime_error {
 public:
  InputError(const SourceLocation& where, const std::string& message)
      : std::runtime_error(fmt::format("{}: error: {}", where.ToString(), message)),
        place_(where.ToString().size() + kError.size()) {}
  explicit InputError(const std::string& message)
      : std::runtime_error("error: " + message), place_(kError.size() - 2) {}

  /// What is wrong, without the place.
  const char* message() const { return what() + place_; }

 private:
  static constexpr std::string_view kError = ": error: ";

  std::size_t place_;  // its length in what()
};

}  // namespace lanelight
