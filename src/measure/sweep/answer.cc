// Writes the best strategies of a sweep for the terminal.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/base/core/text_layout.h"
#include "src/base/stat/values.h"
#include "src/measure/sweep/results.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Returns e.g. "2.31 [2.10, 2.55]".
std::string RatioText(const Json& interval) {
  if (interval.at("value").is_null()) return "infinitely many";  // without any error
  if (!interval.at("low").is_number()) {
    return fmt::format("{:.3g}", interval.at("value").get<double>());
  }
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]", interval.at("value").get<double>(),
                     interval.at("low").get<double>(), interval.at("high").get<double>());
}

// Returns e.g. "reuse=block has 2.31 [2.10, 2.55] times the efficiency of default".
std::string BestText(const Json& leader) {
  const std::string best = leader.at("best"), baseline = leader.at("baseline");
  if (best != baseline) {
    return fmt::format("{} has {} times the efficiency of {}", best,
                       RatioText(leader.at("efficiency")), baseline);
  }
  std::string text = baseline + ", the baseline, is the most efficient";
  if (leader.at("next").is_null()) return text;
  return text + fmt::format("; the next, {}, has {} times its efficiency",
                            leader.at("next").get<std::string>(),
                            RatioText(leader.at("next_efficiency")));
}

// Returns e.g. "not decided between a, b and 3 more (within 12 %)".
std::string UndecidedText(const Json& leader) {
  constexpr std::size_t kMaxNames = 4;
  const std::vector<std::string> names = leader.at("undecided");
  const std::string text = "not decided between " + ListText(names, kMaxNames);
  const Json& within = leader.at("within");
  if (within.is_null()) return text;
  const double excess = within.get<double>();
  return text + (excess < 1 ? fmt::format(" (within {:.2g} %)", 100 * excess)
                            : fmt::format(" (within a factor of {:.{}f})", 1 + excess,
                                          excess < 9 ? 1 : 0));
}

// The ratio to the baseline is left out where that may be as efficient.
std::string VerdictText(const Json& leader) {
  const std::vector<std::string> undecided = leader.at("undecided");
  if (undecided.empty()) return BestText(leader);
  const std::string text = UndecidedText(leader);
  const std::string baseline = leader.at("baseline");
  const bool has_baseline = std::ranges::count(undecided, baseline) > 0;
  return has_baseline ? text : BestText(leader) + "; " + text;
}

std::string LineText(const Json& leader) {
  const auto seeds = leader.at("seeds").get<int>();
  const std::string where = ValuesText(leader.at("values"));
  const std::string count = seeds == 1 ? "one seed" : fmt::format("{} seeds", seeds);
  if (seeds < kMinRankedSeeds && leader.at("within").is_null()) {
    return fmt::format(
        "{}: {} {} not rank strategies; give at least {}: seed = [1, 2, 3, 4]", where,
        count, seeds == 1 ? "does" : "do", kMinRankedSeeds);
  }
  const auto stopped = leader.at("stopped").get<std::size_t>();
  return fmt::format("{}: {}{} ({})", where, VerdictText(leader),
                     stopped > 0 ? fmt::format("; {} stopped early", stopped) : "",
                     count);
}

}  // namespace

std::string ValuesText(const Json& values) {
  std::string text = values.at("scene").get<std::string>();
  for (const auto& [axis, value] : values.items()) {
    if (axis == "scene") continue;
    text += fmt::format(", {} {}{}", axis, value.get<std::string>(),
                        axis == "time" ? " s" : "");
  }
  return text;
}

std::string AnswerText(const Json& leaders) {
  std::string text;
  for (const Json& leader : leaders) text += LineText(leader) + "\n";
  return text;
}

}  // namespace lanelight
