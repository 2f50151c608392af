// Image files that tests build by hand, and what ReadImage makes of them.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/image/image.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/support/input_error.h"

namespace lanelight {

using Bytes = std::vector<int>;

inline std::string Raw(std::initializer_list<int> bytes) {
  std::string out;
  for (int b : bytes) out += static_cast<char>(b);
  return out;
}

/// `count` bytes of a number, the highest first.
inline std::string BigEndian(std::uint32_t value, int count) {
  std::string out;
  for (int i = count - 1; i >= 0; --i) out += static_cast<char>(value >> 8 * i);
  return out;
}

/// Reads an image from a file of that name and content.
inline Image ReadAs(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  return ReadImage(folder.Write(name, content));
}

/// The message of the InputError, or "".
inline std::string ImageError(const std::string& name, const std::string& content) {
  return InputErrorOf([&] { ReadAs(name, content); });
}

}  // namespace lanelight
