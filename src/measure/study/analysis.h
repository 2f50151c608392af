// Statistics of a study's renders, with intervals. docs/study.md documents the members
// under the same names.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/base/stat/convergence.h"
#include "src/base/stat/efficiency.h"
#include "src/base/stat/hypothesis.h"
#include "src/base/stat/interval.h"
#include "src/measure/compare/tile_test.h"
#include "src/measure/report/page.h"
#include "src/measure/study/runs.h"

namespace lanelight {

/// Coverage of the renders' own error estimates.
struct SelfCheck {
  Interval relmse;                      // mean of the estimates
  std::uint64_t inside = 0, total = 0;  // of renders with an interval
  std::uint64_t refused = 0;            // with an estimate, but no interval
};

/// Coverage of the renders' own intervals for one strategy, by seed, and the worst pixels
/// of renders whose interval did not hold.
struct SelfRenders {
  std::map<std::uint64_t, stat::Cluster> seeds;
  std::map<std::array<std::uint64_t, 2>, int> missed;
  double missed_worst_share = 0;  // sum over missed

  /// Adds renders that have an interval.
  void Add(const std::vector<Measurement>& renders);
};

/// A strategy whose intervals hold significantly less often than stated.
struct SelfFailure {
  std::size_t strategy = 0;
  std::uint64_t inside = 0, total = 0;
  std::array<std::uint64_t, 2> pixel = {};  // most frequent worst pixel of missed ones
  double worst_share =
      0;  // fraction of their error in the worst kWorstFraction of pixels
};

struct LevelAnalysis {
  std::uint64_t spp = 0;
  std::size_t repetitions = 0;
  Interval rmse, relmse, relmse_trimmed, mape, variance, bias2, bias;
  Interval relmse_2, relmse_4, relmse_8;  // after filters
  Interval cpu_seconds, wall_seconds;
  std::optional<double> bias_p;
  Rgb mean;
  double worst_share = 0, rays_per_sample = 0, path_length = 0;
  double reference_share = 0;
  std::uint64_t invalid = 0;
  SelfCheck self;
  std::string image;  // name of the first repetition's image; may be empty

  bool ReferenceLimited() const { return reference_share > 0.5; }
};

/// Test of equal means by tile.
struct TileTest {
  TileLayout layout;
  std::vector<double> z;  // signed, normal if the means are equal; NaN: not testable
  /// Tiles that fail with Holm's correction; TestBias() moves some to `shared`.
  std::vector<std::size_t> failed;
  /// Tiles that differ from the reference like those of the other strategies.
  std::vector<std::size_t> shared;
  /// Means of the tiles over all repetitions, and of the reference.
  std::vector<stat::MeanEstimate> means, reference;
  double level = 0;  // false-alarm rate of all tiles together
};

struct StrategyAnalysis {
  std::vector<LevelAnalysis> levels;
  std::vector<stat::Level> costs;    // relative MSE and processor seconds by level
  std::vector<stat::Level> squares;  // MSE and processor seconds by level
  std::vector<stat::Cost> trimmed;   // trimmed relative MSE, at the level `at`
  std::size_t at = 0;                // index of the compared level
  /// Slopes of log RMSE and of log sqrt(relative MSE) over log samples. They differ if
  /// dark and bright pixels converge at different rates.
  std::optional<Interval> order, order_relmse;
  std::optional<stat::TargetCost> to_target;
  std::optional<Interval> efficiency;
  std::optional<Interval> efficiency_trimmed;  // of Measurement::relmse_trimmed
  /// Standard deviation of the logarithm of the efficiency at equal time, by the measured
  /// sample counts of a budget. Both efficiencies' intervals include it.
  double budget_uncertainty = 0;
  stat::RankRange rank;
  stat::MeanEstimate image_mean;  // of all pixels and repetitions at the level `at`
  bool heavy_tailed = false;
  std::vector<StageProfile> stages;
  SelfRenders self;
  std::optional<TileTest> tiles;
  std::string mean, one, variance, bias;  // names of images; may be empty

  bool HasRuns() const { return !levels.empty(); }
  const LevelAnalysis& AtLevel() const { return levels[at]; }
};

struct SceneAnalysis {
  std::vector<StrategyAnalysis> strategies;  // in the order of SceneRuns::strategies
  std::vector<std::size_t> ranking;          // with runs, most efficient first
  std::size_t baseline = 0;
  double target_relmse = 0;
  SelfCheck calibration;
  /// Fraction of intervals that held. Renders of one seed are correlated across
  /// strategies.
  Interval calibration_share;
  std::size_t calibration_seeds = 0;
  std::vector<SelfFailure> self_failures;
  std::size_t bias_tests = 0;
  /// Strategies whose whole image differs from the reference, by Holm's correction. Those
  /// in biased_alike agree with the other strategies, so the reference may be wrong.
  std::vector<std::size_t> biased, biased_alike;
  std::vector<std::size_t> suspect_tiles;  // TileTest::shared of any strategy
  double bias_level = 0;
  std::string verdict;
  std::vector<std::string> cautions;  // Cautions()
  std::vector<MachineInfo> machines;  // machines that rendered cells
  std::string reference_image;        // name
  std::vector<std::string> diffuse_images;
  int report_scale = 1;  // the report's images are smaller by this factor
};

/// Longest list of names in texts.
inline constexpr std::size_t kMaxNames = 4;

/// Largest fraction of the reference's own error at levels that test intervals.
inline constexpr double kMaxReferenceFraction = 0.1;

/// Analyses a scene from its cells on disk, and collects images.
SceneAnalysis AnalyseScene(const SceneRuns& runs, const StudyOptions& options,
                           std::vector<ReportImage>& images);

/// Analyses one sample count of a strategy.
LevelAnalysis AnalyseLevel(const Cells& cells, const Reference& reference,
                           std::uint64_t spp, double confidence);
/// Returns the mean over pixels and repetitions. Its variance is that of pixels, which
/// has more degrees of freedom than that of the means of a few repetitions.
stat::MeanEstimate ImageMean(const Moments& moments);
/// Returns squared errors, at least 0, with seconds, of the first repetitions of a level.
std::vector<stat::Cost> CostsOf(const stat::Level& level, std::size_t repetitions);
/// Sets ranking, efficiencies and ranks of strategies that have levels.
void CompareStrategies(const SceneRuns& runs, const StudyOptions& options,
                       SceneAnalysis& analysis);
stat::MeanEstimate ReferenceMean(const Reference& reference);
/// Tests strategies that have tiles for bias. A difference from the reference that agrees
/// with the consensus of the other strategies is attributed to the reference. Does not
/// test heavy-tailed strategies.
void TestBias(const Reference& reference, SceneAnalysis& analysis);
/// Tests tiles of renders of `spp` samples per pixel, at a false-alarm rate of `level`.
TileTest TestTiles(const Moments& moments, const Reference& reference, std::uint64_t spp,
                   double level);
/// Sets the coverage of the renders' own intervals.
void Calibrate(double confidence, SceneAnalysis& analysis);
/// Returns sentences about the coverage; may be empty.
std::string CalibrationText(const SceneRuns& runs, const SceneAnalysis& analysis);
std::string Verdict(const SceneRuns& runs, const SceneAnalysis& analysis);
/// Returns sentences on why long renders on a quiet machine may rank differently: few
/// samples, ranks that depend on the sample count, or a busy machine.
std::vector<std::string> Cautions(const SceneRuns& runs, const StudyOptions& options,
                                  const SceneAnalysis& analysis);
/// Returns the verdict's sentences about bias; may be empty.
std::string BiasText(const SceneRuns& runs, const SceneAnalysis& analysis);
/// Appends a sentence, which may be empty, to a text.
void AddSentence(const std::string& sentence, std::string& text);
/// Returns "A, B and C", or "7 strategies" for more than `max_names`.
std::string NamesText(const SceneRuns& runs, const std::vector<std::size_t>& strategies,
                      std::size_t max_names = kMaxNames);

}  // namespace lanelight
