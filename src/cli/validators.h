// Checks of flag values that CLI11 does not have.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>

namespace lanelight {

/// A finite number in [low, high]. (CLI::Range lets "nan" through.)
inline CLI::Validator FiniteRange(double low, double high) {
  return CLI::Validator(
      [low, high](const std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        if (number && value >= low && value <= high) return std::string();
        return fmt::format("'{}' is not a number from {} to {}", text, low, high);
      },
      "");
}

/// An integer from 0 to 2^64 - 1. (CLI11 makes 2^64 - 1 of what is negative or larger.)
inline CLI::Validator SeedRange() {
  return CLI::Validator(
      [](const std::string& text) {
        std::uint64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto [at, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc() && at == end) return std::string();
        return fmt::format("'{}' is not an integer from 0 to {}", text,
                           std::numeric_limits<std::uint64_t>::max());
      },
      "");
}

/// Bytes, with a unit or without, e.g. 10GB or 16GiB: the text becomes their number.
/// (CLI11's reads 010 as 8, -1 as the largest number, and speaks of types.)
inline CLI::Validator ByteSize() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint64_t count = 0;
        const char* const end = text.data() + text.size();
        const auto [unit, error] = std::from_chars(text.data(), end, count);
        std::string bytes = std::to_string(count) + std::string(unit, end);
        try {
          if (error == std::errc() && CLI::AsSizeValue(true)(bytes).empty()) {
            text = bytes;
            return std::string();
          }
        } catch (const CLI::ValidationError&) {  // an unknown unit, too much
        }
        return fmt::format(
            "'{}' is not a size: a whole number and a unit, below 16EiB, e.g. 500MB, "
            "10GB or 16GiB",
            text);
      },
      "");
}

}  // namespace lanelight
