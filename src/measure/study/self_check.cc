// Coverage of the intervals that renders state of their own error.
#include <fmt/format.h>

#include <algorithm>

#include "src/measure/compare/metrics.h"
#include "src/measure/study/analysis.h"
#include "src/render/estimate/estimate.h"

namespace lanelight {
namespace {

// Probability that any strategy whose intervals hold is reported.
constexpr double kFalseAlarm = 0.05;

std::vector<stat::Cluster> Clusters(const std::map<std::uint64_t, stat::Cluster>& seeds) {
  std::vector<stat::Cluster> clusters;
  for (const auto& [seed, cluster] : seeds) clusters.push_back(cluster);
  return clusters;
}

SelfFailure Failure(std::size_t strategy, const SelfRenders& self) {
  SelfFailure out;
  out.strategy = strategy;
  for (const auto& [seed, cluster] : self.seeds) {
    out.inside += cluster.successes;
    out.total += cluster.trials;
  }
  out.worst_share = self.missed_worst_share / double(out.total - out.inside);
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  out.pixel = std::ranges::max_element(self.missed, fewer)->first;
  return out;
}

}  // namespace

void SelfRenders::Add(const std::vector<Measurement>& renders) {
  for (const Measurement& m : renders) {
    if (!m.HasSelf()) continue;
    stat::Cluster& cluster = seeds[m.seed];
    ++cluster.trials;
    cluster.successes += m.SelfIntervalCovers();
    if (m.SelfIntervalCovers()) continue;
    ++missed[{m.worst_x, m.worst_y}];
    missed_worst_share += m.worst_share;
  }
}

void Calibrate(double confidence, SceneAnalysis& analysis) {
  std::map<std::uint64_t, stat::Cluster> seeds;
  const double each =
      kFalseAlarm / double(std::max<std::size_t>(1, analysis.strategies.size()));
  for (std::size_t i = 0; i < analysis.strategies.size(); ++i) {
    const StrategyAnalysis& strategy = analysis.strategies[i];
    for (const LevelAnalysis& level : strategy.levels) {
      if (level.reference_share > kMaxReferenceFraction) continue;
      analysis.calibration.inside += level.self.inside;
      analysis.calibration.total += level.self.total;
      analysis.calibration.refused += level.self.refused;
    }
    for (const auto& [seed, cluster] : strategy.self.seeds) {
      seeds[seed].successes += cluster.successes;
      seeds[seed].trials += cluster.trials;
    }
    const Interval own =
        stat::ClusteredProportion(Clusters(strategy.self.seeds), 1 - each);
    if (own.high < kEstimateConfidence) {
      analysis.self_failures.push_back(Failure(i, strategy.self));
    }
  }
  analysis.calibration_seeds = seeds.size();
  analysis.calibration_share = stat::ClusteredProportion(Clusters(seeds), confidence);
}

std::string CalibrationText(const SceneRuns& runs, const SceneAnalysis& analysis) {
  const SelfCheck& self = analysis.calibration;
  if (self.total == 0) {
    return self.refused > 0 ? "No render printed a confidence interval for its own error."
                            : "";
  }
  const Interval& fraction = analysis.calibration_share;
  std::string text = fmt::format("{:.1f} %", 100 * fraction.value);
  if (fraction.HasBounds()) {
    text += fmt::format(" [{:.1f}, {:.1f}]", 100 * fraction.low, 100 * fraction.high);
  }
  text += fmt::format(
      " of {} renders ({} seed{}, shared by the strategies) have their true error inside "
      "their own 95 % interval",
      self.total, analysis.calibration_seeds, analysis.calibration_seeds == 1 ? "" : "s");
  text += self.refused == 0
              ? "."
              : fmt::format("; {} more renders printed no interval.", self.refused);
  for (const SelfFailure& f : analysis.self_failures) {
    text += fmt::format(
        " For {}, {} of {} renders do. In the rest, the worst {:g} % of the pixels "
        "cause {:.0f} % of the error; the worst pixel is most often ({}, {}).",
        runs.strategies[f.strategy].named.name, f.inside, f.total, 100 * kWorstFraction,
        100 * f.worst_share, f.pixel[0], f.pixel[1]);
  }
  return text;
}

}  // namespace lanelight
