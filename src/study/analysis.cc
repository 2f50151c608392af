#include "src/study/analysis.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/stat/multiple.h"
#include "src/study/study_images.h"

namespace lanelight {
namespace {

// The largest sample count with all repetitions; else the largest with the most of them.
std::size_t ComparedLevel(const std::vector<LevelAnalysis>& levels) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].repetitions >= levels[best].repetitions) best = i;
  }
  return best;
}

stat::Level CostsOf(const Cells& cells, std::uint64_t spp) {
  stat::Level level;
  level.samples = double(spp);
  for (const Measurement& m : cells.repetitions) {
    level.error.push_back(m.relmse);
    level.seconds.push_back(m.cpu_seconds);
  }
  return level;
}

class SceneAnalyser {
 public:
  SceneAnalyser(const SceneRuns& runs, const StudyOptions& options,
                std::vector<ReportImage>& images)
      : runs_(runs),
        options_(options),
        images_(images),
        store_(runs.folder + "/cells", runs.window.pixels()) {}

  SceneAnalysis Run() {
    for (const StrategyRuns& runs : runs_.strategies) AddStrategy(runs);
    AddSceneImages(runs_, out_, images_);
    Compare();
    TestBias();
    Calibrate();
    FindTargets();
    out_.verdict = Verdict(runs_, out_);
    return std::move(out_);
  }

 private:
  void AddStrategy(const StrategyRuns& runs) {
    StrategyAnalysis strategy;
    for (std::uint64_t spp : runs.counts) {
      const Cells cells = store_.Load(runs.Text(), spp);
      if (cells.repetitions.empty()) continue;
      strategy.levels.push_back(
          AnalyseLevel(cells, runs_.reference, spp, options_.confidence));
      strategy.costs.push_back(CostsOf(cells, spp));
    }
    if (strategy.HasRuns()) {
      strategy.at = ComparedLevel(strategy.levels);
      strategy.heavy_tailed = strategy.AtLevel().worst_share > kHeavyTail;
      FitRmseOrder(strategy);
      const Cells cells = store_.Load(runs.Text(), strategy.AtLevel().spp);
      strategy.stages = cells.stages;
      for (const Measurement& m : cells.repetitions) {
        strategy.trimmed.push_back({std::max(0.0, m.relmse_trimmed), m.cpu_seconds});
      }
      if (cells.repetitions.size() >= 2) {
        strategy.tiles = TestTiles(cells.moments, runs_.reference, kBiasLevel);
      }
      AddStrategyImages(runs_, out_.strategies.size(), cells, strategy, images_);
    }
    out_.strategies.push_back(std::move(strategy));
  }

  // Levels whose error is mostly the reference's would bend the line.
  void FitRmseOrder(StrategyAnalysis& strategy) const {
    std::vector<stat::Level> usable;
    for (std::size_t i = 0; i < strategy.levels.size(); ++i) {
      if (strategy.levels[i].ReferenceLimited()) continue;
      if (strategy.levels[i].repetitions < strategy.AtLevel().repetitions) continue;
      usable.push_back(strategy.costs[i]);
    }
    strategy.order = stat::FitOrder(usable, options_.confidence);
  }

  std::vector<stat::Cost> CostsAt(const StrategyAnalysis& strategy,
                                  std::size_t repetitions) const {
    const stat::Level& level = strategy.costs[strategy.at];
    std::vector<stat::Cost> costs;
    for (std::size_t r = 0; r < repetitions; ++r) {
      costs.push_back({std::max(0.0, level.error[r]), level.seconds[r]});
    }
    return costs;
  }

  Interval Relative(std::span<const stat::Cost> baseline,
                    std::span<const stat::Cost> other, bool same) const {
    if (same) return {1, 1, 1};
    return stat::EfficiencyRatio(baseline, other, options_.confidence);
  }

  // All strategies with runs, by the repetitions that all of them have.
  void Compare() {
    std::size_t repetitions = static_cast<std::size_t>(options_.Repetitions());
    for (std::size_t i = 0; i < out_.strategies.size(); ++i) {
      if (!out_.strategies[i].HasRuns()) continue;
      out_.ranking.push_back(i);
      repetitions = std::min(repetitions, out_.strategies[i].AtLevel().repetitions);
    }
    if (out_.ranking.empty()) return;
    out_.baseline = out_.ranking.front();
    std::vector<std::vector<stat::Cost>> costs;
    for (std::size_t i : out_.ranking) {
      costs.push_back(CostsAt(out_.strategies[i], repetitions));
    }
    const auto ranks = stat::RankByEfficiency(costs, options_.confidence);
    for (std::size_t k = 0; k < costs.size(); ++k) {
      StrategyAnalysis& strategy = out_.strategies[out_.ranking[k]];
      strategy.rank = ranks[k];
      strategy.efficiency = Relative(costs.front(), costs[k], k == 0);
      strategy.efficiency_trimmed =
          Relative(std::span(out_.strategies[out_.baseline].trimmed).first(repetitions),
                   std::span(strategy.trimmed).first(repetitions), k == 0);
    }
    SortRanking();
  }

  void SortRanking() {
    std::sort(out_.ranking.begin(), out_.ranking.end(),
              [&](std::size_t a, std::size_t b) {
                const double ea = out_.strategies[a].efficiency->value;
                const double eb = out_.strategies[b].efficiency->value;
                return ea != eb ? ea > eb : a < b;
              });
  }

  void TestBias() {
    std::vector<double> p;
    std::vector<std::size_t> tested;
    for (std::size_t i = 0; i < out_.strategies.size(); ++i) {
      const StrategyAnalysis& strategy = out_.strategies[i];
      if (!strategy.HasRuns() || !strategy.AtLevel().bias_p) continue;
      // Most renders miss the rarest samples, and their scatter does not show it: the
      // mean is low without being biased.
      if (strategy.heavy_tailed) continue;
      p.push_back(*strategy.AtLevel().bias_p);
      tested.push_back(i);
    }
    out_.bias_tests = p.size();
    out_.bias_level = kBiasLevel;
    for (std::size_t k : stat::HolmRejections(p, kBiasLevel)) {
      out_.biased.push_back(tested[k]);
    }
  }

  // Where the reference carries the error, the true error is not known well enough.
  void Calibrate() {
    for (const StrategyAnalysis& strategy : out_.strategies) {
      for (const LevelAnalysis& level : strategy.levels) {
        if (level.ReferenceLimited()) continue;
        out_.calibration.inside += level.self.inside;
        out_.calibration.total += level.self.total;
      }
    }
  }

  void FindTargets() {
    if (out_.ranking.empty()) return;
    const StrategyAnalysis& baseline = out_.strategies[out_.baseline];
    out_.target_relmse =
        options_.target_relmse.value_or(std::max(0.0, baseline.AtLevel().relmse.value));
    if (out_.target_relmse <= 0) return;
    for (StrategyAnalysis& strategy : out_.strategies) {
      if (!strategy.HasRuns()) continue;
      strategy.to_target =
          stat::CostToTarget(strategy.costs, out_.target_relmse, options_.confidence);
    }
  }

  const SceneRuns& runs_;
  const StudyOptions& options_;
  std::vector<ReportImage>& images_;
  CellStore store_;
  SceneAnalysis out_;
};

}  // namespace

SceneAnalysis AnalyseScene(const SceneRuns& runs, const StudyOptions& options,
                           std::vector<ReportImage>& images) {
  return SceneAnalyser(runs, options, images).Run();
}

}  // namespace lanelight
