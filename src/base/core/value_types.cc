#include "src/base/core/value_types.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

// Parses digits with an optional point, without sign and exponent.
std::optional<double> ParseDecimal(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789.") != text.npos) return {};
  return ParseNumber<double>(text);
}

struct TimeUnit {
  std::string_view name;
  double seconds;
};
// In the order in which a text has them.
constexpr TimeUnit kTimeUnits[] = {
    {"d", 86400}, {"h", 3600}, {"m", 60}, {"s", 1}, {"ms", 1e-3}};

// "1h30m": each unit once, the larger one first.
std::optional<double> ParseUnitsOfTime(std::string_view text) {
  double seconds = 0;
  const TimeUnit* next = std::begin(kTimeUnits);
  while (!text.empty()) {
    const std::size_t digits =
        std::min(text.find_first_not_of("0123456789."), text.size());
    const auto value = ParseDecimal(text.substr(0, digits));
    text.remove_prefix(digits);
    const std::string_view name =
        text.substr(0, std::min(text.find_first_of("0123456789."), text.size()));
    text.remove_prefix(name.size());
    next = std::find_if(next, std::end(kTimeUnits),
                        [&](const TimeUnit& unit) { return unit.name == name; });
    if (!value || next == std::end(kTimeUnits)) return {};
    seconds += *value * next->seconds;
    ++next;
  }
  return seconds;
}

}  // namespace

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

std::optional<std::uint64_t> CountType::Read(const std::string& text) const {
  // Without a prefix all 64 bits count.
  std::optional<std::uint64_t> count = ParseNumber<std::uint64_t>(text);
  if (!count && !text.empty()) {
    constexpr std::string_view kPrefixes = "kMGT";
    const char last = text.back() == 'K' ? 'k' : text.back();
    const std::size_t power = kPrefixes.find(last);
    const auto value = ParseDecimal(std::string_view(text).substr(0, text.size() - 1));
    if (power == kPrefixes.npos || !value) return {};
    // Doubles hold whole numbers up to 2^53.
    const double all = *value * std::pow(1e3, double(power) + 1);
    if (all != std::round(all) || all > 9e15) return {};
    count = static_cast<std::uint64_t>(all);
  }
  return count && *count >= low && *count <= high ? count : std::nullopt;
}

std::string CountType::Right(const std::string&) const {
  return fmt::format("an integer from {} to {}, e.g. 256, 10k or 2M", low, high);
}

std::optional<double> SecondsType::Read(const std::string& text) const {
  std::optional<double> seconds = ParseNumber<double>(text);
  if (!seconds) seconds = ParseUnitsOfTime(text);
  // Not so for NaN.
  return seconds && *seconds >= low && *seconds <= high ? seconds : std::nullopt;
}

std::string SecondsType::Right(const std::string&) const {
  return fmt::format("a time of {} to {} seconds, e.g. 90, 5m, 1h30m or 500ms", low,
                     high);
}

std::optional<double> PercentErrorType::Read(const std::string& text) const {
  if (!text.ends_with('%')) return {};
  const auto percent = ParseNumber<double>(text.substr(0, text.size() - 1));
  if (!percent || !(*percent >= low && *percent <= high)) return {};
  return *percent * *percent * 1e-4;
}

std::string PercentErrorType::Write(double relative_mse) const {
  return fmt::format("{:.12g}%", 100 * std::sqrt(relative_mse));
}

std::string PercentErrorType::Right(const std::string&) const {
  return fmt::format(
      "an error in percent, {}% to {}%, e.g. 1% or 0.5% (--simd chooses SIMD targets)",
      low, high);
}

}  // namespace lanelight
