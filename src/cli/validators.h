// Checks of flag values that CLI11 does not have.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <string>

#include "src/base/core/value_types.h"

namespace lanelight {

/// A value of this type (src/base/core/value_types.h), read as those of settings are; the
/// text becomes the one that CLI11 reads alike.
template <class Type>
CLI::Validator ValueOf(const Type& type) {
  return CLI::Validator(
      [type](std::string& text) {
        try {
          text = type.Write(ReadValue(type, text));
        } catch (const InputError& error) {
          return std::string(error.message());
        }
        return std::string();
      },
      "");
}

/// A finite number, or an integer, of [low, high]. (CLI::Range lets "nan" through, and
/// CLI11 makes 2^64 - 1 of a seed that is negative or larger.)
template <class T>
CLI::Validator ValueFrom(T low, T high) {
  return ValueOf(NumberType<T>{low, high});
}

/// The name of a file of this kind: before another word, most likely an input, is written
/// over.
inline auto EndsIn(const std::string& extension) {
  return [extension](const std::string& path) {
    return path.ends_with(extension)
               ? std::string()
               : fmt::format("'{}' does not end in {}", path, extension);
  };
}

}  // namespace lanelight
