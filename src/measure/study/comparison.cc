// Ranks strategies by efficiency, with the uncertainty of a budget's sample counts.
#include <algorithm>
#include <cmath>

#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

class Comparison {
 public:
  Comparison(const SceneRuns& runs, const StudyOptions& options, SceneAnalysis& out)
      : runs_(runs), options_(options), out_(out) {}

  // Compares all strategies with runs, by the repetitions that all of them have.
  void Run() {
    repetitions_ = std::size_t(options_.Repetitions());
    for (std::size_t i = 0; i < out_.strategies.size(); ++i) {
      if (!out_.strategies[i].HasRuns()) continue;
      out_.ranking.push_back(i);
      repetitions_ = std::min(repetitions_, out_.strategies[i].AtLevel().repetitions);
    }
    if (out_.ranking.empty()) return;
    out_.baseline = out_.ranking.front();
    FindUncertainties();
    Rank();
    SortRanking();
  }

 private:
  // Sets the uncertainty of comparisons at equal time. If errors do not fall as 1 /
  // samples, efficiency is proportional to samples^-(1 + 2 order). Timed renders estimate
  // the sample counts of a budget, with a spread; the actual time also differs from the
  // budget.
  void FindUncertainties() {
    if (!options_.budget || !options_.spp.empty()) return;
    std::vector<double> times;
    for (std::size_t i : out_.ranking) times.push_back(TimeOf(i));
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    const double typical = times[times.size() / 2];
    for (std::size_t i : out_.ranking) {
      StrategyAnalysis& s = out_.strategies[i];
      const double missed = std::log(TimeOf(i) / typical);
      s.budget_uncertainty =
          Sensitivity(s) * std::hypot(runs_.strategies[i].count_deviation,
                                      std::isfinite(missed) ? missed : 0);
    }
  }

  double TimeOf(std::size_t i) const {
    return out_.strategies[i].AtLevel().cpu_seconds.value;
  }

  // Returns the largest |1 + 2 order| within the bounds; 1 (order 0) if unknown.
  static double Sensitivity(const StrategyAnalysis& s) {
    if (!s.order_relmse) return 1;
    const Interval& order = *s.order_relmse;
    double maximum = std::abs(1 + 2 * order.value);
    if (!order.HasBounds()) return std::max(maximum, 1.0);
    for (double bound : {order.low, order.high}) {
      maximum = std::max(maximum, std::abs(1 + 2 * bound));
    }
    return maximum;
  }

  Interval Relative(std::span<const stat::Cost> other_costs,
                    std::span<const stat::Cost> baseline_costs, std::size_t other) const {
    if (other == out_.baseline) return WithoutBounds(1);  // nothing is estimated
    const double extra_uncertainty =
        std::hypot(out_.strategies[out_.baseline].budget_uncertainty,
                   out_.strategies[other].budget_uncertainty);
    return stat::Widened(
        stat::EfficiencyRatio(baseline_costs, other_costs, options_.confidence),
        extra_uncertainty, options_.confidence);
  }

  void Rank() {
    std::vector<std::vector<stat::Cost>> costs;
    std::vector<double> uncertainties;
    for (std::size_t i : out_.ranking) {
      const StrategyAnalysis& strategy = out_.strategies[i];
      costs.push_back(CostsOf(strategy.costs[strategy.at], repetitions_));
      uncertainties.push_back(out_.strategies[i].budget_uncertainty);
    }
    const auto trimmed = [&](std::size_t i) {
      return std::span(out_.strategies[i].trimmed).first(repetitions_);
    };
    const auto ranks = stat::RankByEfficiency(costs, options_.confidence, uncertainties);
    for (std::size_t k = 0; k < costs.size(); ++k) {
      const std::size_t i = out_.ranking[k];
      StrategyAnalysis& strategy = out_.strategies[i];
      strategy.rank = ranks[k];
      strategy.efficiency = Relative(costs[k], costs.front(), i);
      strategy.efficiency_trimmed = Relative(trimmed(i), trimmed(out_.baseline), i);
    }
  }

  void SortRanking() {
    std::ranges::sort(out_.ranking, [&](std::size_t a, std::size_t b) {
      const double ea = out_.strategies[a].efficiency->value;
      const double eb = out_.strategies[b].efficiency->value;
      return ea != eb ? ea > eb : a < b;
    });
  }

  const SceneRuns& runs_;
  const StudyOptions& options_;
  SceneAnalysis& out_;
  std::size_t repetitions_ = 0;
};

}  // namespace

std::vector<stat::Cost> CostsOf(const stat::Level& level, std::size_t repetitions) {
  std::vector<stat::Cost> costs;
  for (std::size_t r = 0; r < repetitions; ++r) {
    costs.push_back({std::max(0.0, level.error[r]), level.seconds[r]});
  }
  return costs;
}

void CompareStrategies(const SceneRuns& runs, const StudyOptions& options,
                       SceneAnalysis& analysis) {
  Comparison(runs, options, analysis).Run();
}

}  // namespace lanelight
