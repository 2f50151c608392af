// Writes the best strategies of a sweep for the terminal.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

std::string OpenText(const Json& leader) {
  std::string text;
  const Json& equals = leader.at("equals");
  if (equals.is_number() && equals > 0) {
    const auto n = equals.get<long>();
    text = fmt::format("; not decided: {} {} may be as efficient", n,
                       n == 1 ? "other" : "others");
  }
  const auto stopped = leader.at("stopped").get<std::size_t>();
  if (stopped > 0) text += fmt::format("; {} stopped early", stopped);
  return text;
}

std::string LineText(const Json& leader) {
  const auto seeds = leader.at("seeds").get<int>();
  const std::string where = ValuesText(leader.at("values"));
  if (seeds < kMinRankedSeeds) {
    return fmt::format(
        "{}: {} {} not rank strategies; give at least {}: seed = [1, 2, 3, 4]", where,
        seeds == 1 ? "one seed" : fmt::format("{} seeds", seeds),
        seeds == 1 ? "does" : "do", kMinRankedSeeds);
  }
  return fmt::format("{}: {}{} ({} seeds)", where, BestText(leader), OpenText(leader),
                     seeds);
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
