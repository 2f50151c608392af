#include "src/core/value_types.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "src/core/suggest.h"

namespace lanelight {

std::string ShownValue(std::string_view text) {
  return ParseNumber<double>(text) ? std::string(text) : Quoted(text);
}

std::string OneOf(const std::vector<std::string>& names, const std::string& found) {
  const std::string nearest = NearestName(found, names);
  return "one of " + QuotedList(names) +
         (nearest.empty() ? "" : "; did you mean " + Quoted(nearest) + "?");
}

std::optional<bool> FlagType::Read(const std::string& text) const {
  if (text == "true" || text == "false") return text == "true";
  return std::nullopt;
}

std::optional<std::array<int, 2>> SizeType::Read(const std::string& text) const {
  const std::vector<int> v = ParseNumbers<int>(text, 'x');
  if (v.size() != 2 || v[0] < 1 || v[1] < 1 || std::max(v[0], v[1]) > longest) return {};
  return std::array{v[0], v[1]};
}

std::string SizeType::Write(const std::array<int, 2>& size) const {
  return fmt::format("{}x{}", size[0], size[1]);
}

std::string SizeType::Right(const std::string&) const {
  return fmt::format("WIDTHxHEIGHT with sides of 1 to {} pixels, e.g. 640x480", longest);
}

std::optional<std::array<int, 4>> WindowType::Read(const std::string& text) const {
  const std::vector<int> v = ParseNumbers<int>(text, ',');
  if (v.size() != 4 || v[0] < 0 || v[1] < 0 || v[2] <= v[0] || v[3] <= v[1]) return {};
  return std::array{v[0], v[1], v[2], v[3]};
}

std::string WindowType::Write(const std::array<int, 4>& window) const {
  return fmt::format("{}", fmt::join(window, ","));
}

std::string WindowType::Right(const std::string&) const {
  return "x0,y0,x1,y1 in pixels with 0 <= x0 < x1 and 0 <= y0 < y1";
}

std::optional<std::uint64_t> BytesType::Read(const std::string& text) const {
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  std::optional<std::uint64_t> bytes = ParseNumber<std::uint64_t>(text.substr(0, digits));
  std::string unit;  // "", "b", "k", "kb", "kib"
  for (const char c : text.substr(digits)) {
    if (c != ' ') unit += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (unit.ends_with('b')) unit.pop_back();
  const bool binary = unit.size() == 2 && unit[1] == 'i';
  if (binary) unit.pop_back();
  constexpr std::string_view kPowers = "kmgtpe";
  const std::size_t power = unit.empty() ? 0 : kPowers.find(unit) + 1;
  if (!bytes || unit.size() > 1 || (power == 0 && !unit.empty())) return {};
  const std::uint64_t factor = binary ? 1024 : 1000;
  for (std::size_t i = 0; i < power; ++i) {
    if (*bytes > std::numeric_limits<std::uint64_t>::max() / factor) return {};
    *bytes *= factor;
  }
  return bytes;
}

std::string BytesType::Right(const std::string&) const {
  return "a size: a whole number and a unit, below 16EiB, e.g. 500MB, 10GB or 16GiB";
}

}  // namespace lanelight
