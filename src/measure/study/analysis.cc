#include "src/measure/study/analysis.h"

#include <algorithm>
#include <cmath>

#include "src/measure/compare/metrics.h"
#include "src/measure/compare/tile_test.h"
#include "src/measure/study/study.h"
#include "src/scene/prepare/parameters.h"

namespace lanelight {
namespace {

// Returns the largest sample count that has the largest number of repetitions.
std::size_t ComparedLevel(const std::vector<LevelAnalysis>& levels) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].repetitions >= levels[best].repetitions) best = i;
  }
  return best;
}

stat::Level LevelOf(const Cells& cells, std::uint64_t spp, double Measurement::* error) {
  stat::Level level;
  level.samples = double(spp);
  for (const Measurement& m : cells.repetitions) {
    level.error.push_back(m.*error);
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
        store_(runs.folder + "/cells", runs.window),
        pictured_(PicturedStrategies(runs)) {}

  SceneAnalysis Run() {
    for (const StrategyRuns& runs : runs_.strategies) AddStrategy(runs);
    AddSceneImages(runs_, out_, images_);
    CompareStrategies(runs_, options_, out_);
    TestBias(runs_.reference, out_);
    Calibrate(options_.confidence, out_);
    FindTargets();
    out_.verdict = Verdict(runs_, out_);
    out_.cautions = Cautions(runs_, options_, out_);
    return std::move(out_);
  }

 private:
  void AddStrategy(const StrategyRuns& runs) {
    StrategyAnalysis strategy;
    const std::size_t index = out_.strategies.size();
    std::vector<std::vector<Rgb>> firsts;
    for (std::uint64_t spp : runs.counts) {
      const Cells cells = Load(runs, spp);
      if (cells.repetitions.empty()) continue;
      for (const Measurement& m : cells.repetitions) AddMachine(m.machine, out_.machines);
      strategy.levels.push_back(
          AnalyseLevel(cells, runs_.reference, spp, options_.confidence));
      if (strategy.levels.back().reference_share <= kMaxReferenceFraction) {
        strategy.self.Add(cells.repetitions);
      }
      strategy.costs.push_back(LevelOf(cells, spp, &Measurement::relmse));
      strategy.squares.push_back(LevelOf(cells, spp, &Measurement::mse));
      if (pictured_.contains(index)) firsts.push_back(cells.first);
    }
    if (strategy.HasRuns()) {
      strategy.at = ComparedLevel(strategy.levels);
      strategy.heavy_tailed = strategy.AtLevel().worst_share > kHeavyTail;
      strategy.order = FitOrder(strategy, strategy.squares, runs_.reference.OwnMse());
      strategy.order_relmse =
          FitOrder(strategy, strategy.costs, runs_.reference.OwnRelMse());
      const Cells cells = Load(runs, strategy.AtLevel().spp);
      strategy.stages = cells.stages;
      for (const Measurement& m : cells.repetitions) {
        strategy.trimmed.push_back({std::max(0.0, m.relmse_trimmed), m.cpu_seconds});
      }
      if (cells.repetitions.size() >= 2) {
        strategy.image_mean = ImageMean(cells.moments);
        strategy.tiles =
            TestTiles(cells.moments, runs_.reference, strategy.AtLevel().spp, kBiasLevel);
      }
      AddStrategyImages(runs_, index, cells, strategy, images_);
      AddLevelImages(runs_, {index, pictured_.size(), firsts}, strategy, images_);
    }
    out_.strategies.push_back(std::move(strategy));
  }

  Cells Load(const StrategyRuns& runs, std::uint64_t spp) const {
    Cells cells = store_.Load(runs.Text(), spp);
    cells.moments.pixels_as_one =
        DependenceFactor(GroupsOf(runs.named.strategy).dependents);
    return cells;
  }

  // Fits one kind of squared error; `own`: that of the reference. Leaves out levels whose
  // error is mostly the reference's.
  std::optional<Interval> FitOrder(const StrategyAnalysis& strategy,
                                   const std::vector<stat::Level>& levels,
                                   double own) const {
    std::vector<stat::Level> usable;
    for (const stat::Level& level : levels) {
      if (level.error.size() < strategy.AtLevel().repetitions) continue;
      const double error = stat::MeanInterval(level.error, options_.confidence).value;
      if (own > error) continue;
      usable.push_back(level);
    }
    return stat::FitOrder(usable, options_.confidence);
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
  const std::set<std::size_t> pictured_;  // indices
  SceneAnalysis out_;
};

}  // namespace

SceneAnalysis AnalyseScene(const SceneRuns& runs, const StudyOptions& options,
                           std::vector<ReportImage>& images) {
  return SceneAnalyser(runs, options, images).Run();
}

}  // namespace lanelight
