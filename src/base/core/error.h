// Errors in what the user gave us: they carry a place and say what would be right.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace lanelight {

struct SourceLocation;  // src/base/core/source_location.h

/// A mistake in the input. what() is a complete message: place, what was found, what
/// is supported.
class InputError : public std::runtime_error {
 public:
  InputError(const SourceLocation& where, const std::string& message);
  explicit InputError(const std::string& message);

  /// What is wrong, without the place.
  const char* message() const { return what() + place_; }

 private:
  std::size_t place_;  // its length in what()
};

}  // namespace lanelight
