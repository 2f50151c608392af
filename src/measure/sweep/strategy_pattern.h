// Strategies of a sweep file that leave parts open: every value in their place is a
// strategy, and the open parts are axes of the sweep's page.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/base/core/error.h"

namespace lanelight {

/// What a strategy is on the page: one of the strategies that a pattern stands for, or
/// one by itself.
struct StrategyPlace {
  std::string family;  // the pattern with "*" in its open parts: "roulette=throughput:*"
  /// The open parts, by what stands before them: {"roulette=throughput", "0.05"}.
  std::map<std::string, std::string> parameters;

  bool operator==(const StrategyPlace&) const = default;
};

struct PatternStrategy {
  std::string text;  // for StrategyNamed()
  StrategyPlace place;
};

/// The strategies that a text stands for, the last open part changing fastest. "{a, b}"
/// stands for each of these texts, "*" for the name of each choice of its axis
/// ("points=*"). One without open parts stands for itself. Throws InputError at `where`
/// for braces that do not close or hold nothing, for a "*" elsewhere, and for more than
/// kMostPatternStrategies.
std::vector<PatternStrategy> ExpandStrategy(const std::string& text,
                                            const SourceLocation& where);

inline constexpr std::size_t kMostPatternStrategies = 10000;

}  // namespace lanelight
