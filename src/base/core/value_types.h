// Types of values that flags and files state as text, each with a parser, a printer, and
// a description of valid texts for messages.
#pragma once

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/base/core/error.h"

namespace lanelight {

/// Parses the whole text as a decimal number, with an optional plus in front. Empty if it
/// is none, or too large.
template <class T>
std::optional<T> ParseNumber(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  T value{};
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || next != end) return std::nullopt;
  return value;
}

/// Numbers with a character between each two of them, e.g. "3/16"; empty for any other
/// text.
template <class T>
std::vector<T> ParseNumbers(std::string_view text, char separator) {
  std::vector<T> values;
  while (true) {
    const std::size_t end = text.find(separator);
    const std::optional<T> value = ParseNumber<T>(text.substr(0, end));
    if (!value) return {};
    values.push_back(*value);
    if (end == text.npos) return values;
    text.remove_prefix(end + 1);
  }
}

/// `text` as messages show it: numbers as they are, all else in quotes.
std::string ShownValue(std::string_view text);

// In each type, Read parses a text, Write prints a value, and Right describes valid texts
// for messages, after "is not".

/// An integer, or another number, of [low, high]; never NaN.
template <class T>
struct NumberType {
  T low{}, high{};

  std::optional<T> Read(const std::string& text) const {
    const std::optional<T> value = ParseNumber<T>(text);
    return value && *value >= low && *value <= high ? value : std::nullopt;
  }
  std::string Write(T value) const { return fmt::format("{}", value); }
  std::string Right(const std::string&) const {
    return fmt::format("{} from {} to {}",
                       std::is_integral_v<T> ? "an integer" : "a number", low, high);
  }
};

/// "true" or "false".
struct FlagType {
  std::optional<bool> Read(const std::string& text) const;
  std::string Write(bool value) const { return value ? "true" : "false"; }
  std::string Right(const std::string&) const { return "true or false"; }
};

/// "640x480".
struct SizeType {
  int longest;  // side

  std::optional<std::array<int, 2>> Read(const std::string& text) const;
  std::string Write(const std::array<int, 2>& size) const;
  std::string Right(const std::string&) const;
};

/// "x0,y0,x1,y1": a rectangle of pixels that is not empty, its end exclusive.
struct WindowType {
  std::optional<std::array<int, 4>> Read(const std::string& text) const;
  std::string Write(const std::array<int, 4>& window) const;
  std::string Right(const std::string&) const;
};

/// A count from low to high, with a prefix of thousands or without: "10k", "1.5M", "2G".
struct CountType {
  std::uint64_t low{}, high{};

  std::optional<std::uint64_t> Read(const std::string& text) const;
  std::string Write(std::uint64_t count) const { return std::to_string(count); }
  std::string Right(const std::string&) const;
};

/// Seconds from low to high, alone or with units: "90", "5m", "1h30m", "500ms", "2d".
struct SecondsType {
  double low{}, high{};

  std::optional<double> Read(const std::string& text) const;
  std::string Write(double seconds) const { return fmt::format("{}", seconds); }
  std::string Right(const std::string&) const;
};

/// A relative MSE, written as its root in percent: "1%" is 0.0001. The percent sign is
/// required, so that the two are not confused.
struct PercentErrorType {
  double low{}, high{};  // percent

  std::optional<double> Read(const std::string& text) const;
  std::string Write(double relative_mse) const;
  std::string Right(const std::string&) const;
};

/// Any text but an empty one.
struct TextType {
  const char* right;

  std::optional<std::string> Read(const std::string& text) const {
    return text.empty() ? std::nullopt : std::optional(text);
  }
  std::string Write(const std::string& text) const { return text; }
  std::string Right(const std::string&) const { return right; }
};

/// One of `names`, also with the one that was meant: what Right says of a name.
std::string OneOf(const std::vector<std::string>& names, const std::string& found);

/// The names of an enumeration's values, or of a few others.
template <class E>
struct NamesType {
  std::vector<std::pair<std::string, E>> names;

  std::optional<E> Read(const std::string& text) const {
    for (const auto& [name, value] : names) {
      if (name == text) return value;
    }
    return std::nullopt;
  }
  /// Empty for a value without a name.
  std::string Write(const E& value) const {
    for (const auto& [name, of] : names) {
      if (of == value) return name;
    }
    return "";
  }
  std::string Right(const std::string& text) const { return OneOf(Names(), text); }
  std::vector<std::string> Names() const {
    std::vector<std::string> all;
    for (const auto& [name, unused] : names) all.push_back(name);
    return all;
  }
};

/// The names that Name() gives the first `count` values of an enumeration.
template <class E>
NamesType<E> NamesOf(int count) {
  NamesType<E> type;
  for (int i = 0; i < count; ++i) {
    type.names.emplace_back(Name(static_cast<E>(i)), static_cast<E>(i));
  }
  return type;
}

/// The value of a text. Throws InputError without a place for any that is not right.
template <class Type>
auto ReadValue(const Type& type, const std::string& text) {
  if (auto value = type.Read(text)) return *std::move(value);
  throw InputError("{} is not {}", ShownValue(text), type.Right(text));
}

}  // namespace lanelight
