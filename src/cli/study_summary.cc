#include "src/cli/texts.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/text_layout.h"
#include "src/base/stat/values.h"
#include "src/cli/console.h"
#include "src/cli/progress.h"

namespace lanelight {
namespace {

constexpr std::size_t kLongestName = 30;

std::string Known(const Interval& v) {
  return std::isfinite(v.value) ? EstimateText(v) : "-";
}

// Returns "±0.12", or "±<0.01" where rounding would give zero.
std::string HalfWidth(double half, int digits) {
  const double least = std::pow(10.0, -digits);
  if (half < least / 2) return fmt::format("±<{:.{}f}", least, digits);
  return fmt::format("±{:.{}f}", half, digits);
}

// For symmetric intervals.
std::string PlusMinus(const Interval& v) {
  if (!v.HasBounds()) return Known(v);
  return fmt::format("{:.2f} {}", v.value, HalfWidth(v.high - v.value, 2));
}

std::string Percent(const Interval& v) {
  if (!v.HasBounds() || !(v.value > 0)) return Known(WithoutBounds(v.value));
  const double half = 100 * (v.high - v.value) / v.value;
  return fmt::format("{:.3g} {} %", v.value, HalfWidth(half, half < 9.95 ? 1 : 0));
}

std::string RankText(const stat::RankRange& rank) {
  return rank.best == rank.worst ? fmt::format("{}", rank.best)
                                 : fmt::format("{}-{}", rank.best, rank.worst);
}

std::string TargetText(const std::optional<stat::TargetCost>& target) {
  if (!target) return "-";
  return DurationText(target->seconds.value) + (target->extrapolated ? "*" : "");
}

std::string Short(const std::string& name) {
  return name.size() <= kLongestName ? name : name.substr(0, kLongestName - 3) + "...";
}

using Cells = std::vector<std::string>;

Cells RowOf(const StrategyRuns& runs, const StrategyAnalysis& s) {
  const LevelAnalysis& level = s.AtLevel();
  return {RankText(s.rank),
          Short(runs.named.name),
          std::to_string(level.spp),
          Known(*s.efficiency),
          Known(*s.efficiency_trimmed),
          Percent(level.relmse),
          DurationText(level.cpu_seconds.value),
          s.order ? PlusMinus(*s.order) : "-",
          TargetText(s.to_target),
          s.heavy_tailed ? "heavy tail" : ""};
}

std::string RankingTable(const SceneStudy& study) {
  std::vector<Cells> lines = {{"rank", "strategy", "spp", "efficiency", "trimmed",
                               "relative MSE", "cpu", "order", "to target", ""}};
  for (const std::size_t i : study.analysis.ranking) {
    lines.push_back(RowOf(study.runs.strategies[i], study.analysis.strategies[i]));
  }
  return TextTable(lines, {TerminalColumns(Stream::kOutput), 2, 1});
}

std::string Wrap(const std::string& text) {
  return Wrapped(text, TerminalColumns(Stream::kOutput)) + "\n";
}

// "points=sobol, scene: the same as default on this scene, not rendered again".
std::string EquivalentStrategies(const SceneRuns& runs) {
  std::string text;
  for (std::size_t i = 0; i < runs.strategies.size(); ++i) {
    std::string names;
    for (const StrategyRuns& s : runs.strategies) {
      if (s.same_as != i) continue;
      names += (names.empty() ? "" : ", ") + s.named.name;
    }
    if (names.empty()) continue;
    text +=
        Wrap(fmt::format("    =  {}: the same as {} on this scene, not rendered again",
                         names, runs.strategies[i].named.name));
  }
  return text;
}

}  // namespace

std::string StudySummary(const SceneStudy& study, const StudyOptions& options) {
  const SceneRuns& runs = study.runs;
  const SceneAnalysis& analysis = study.analysis;
  std::string text = fmt::format("\n{}: ", runs.name);
  if (!runs.error.empty()) return text + runs.error + "\n";
  text +=
      fmt::format("{}x{} pixels, {} repetitions, {:g} % intervals, reference {}\n",
                  runs.window.width(), runs.window.height(), options.Repetitions(),
                  100 * options.confidence,
                  runs.reference.rendered() ? fmt::format("of {} spp", runs.reference.spp)
                                            : runs.reference.files.front());
  for (const MachineInfo& machine : analysis.machines) {
    text += MachineText(machine) + "\n";
  }
  text += "\n";
  text += RankingTable(study);
  text += EquivalentStrategies(runs);
  for (const StrategyRuns& s : runs.strategies) {
    if (s.status == RunStatus::kOk || s.status == RunStatus::kSame) continue;
    text += Wrap(
        fmt::format("-  {}  {}: {}", Short(s.named.name), Name(s.status), s.message));
  }
  text += fmt::format(
      "\nto target: processor time to a relative MSE of {:.3g}; * extrapolated\n\n",
      analysis.target_relmse);
  text += Wrap(analysis.verdict);
  for (const std::string& caution : analysis.cautions)
    text += Wrap("warning: " + caution);
  return text + (runs.differs.empty() ? "" : Wrap(runs.differs));
}

}  // namespace lanelight
