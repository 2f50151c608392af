// What the renders of a study say, with intervals. The members are documented in
// docs/study.md under the same names.
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

/// How often the renders' own error estimates held.
struct SelfCheck {
  Interval relmse;                      // mean of the estimates
  std::uint64_t inside = 0, total = 0;  // of the renders that stated an interval
  std::uint64_t refused = 0;            // stated an estimate, and no interval about it
};

/// Of one strategy: whether renders' own intervals held, by seed, and where those that
/// did not have their worst pixel.
struct SelfRenders {
  std::map<std::uint64_t, stat::Cluster> seeds;
  std::map<std::array<std::uint64_t, 2>, int> missed;
  double missed_worst_share = 0;  // sum over these

  /// Renders without an interval are left out.
  void Add(const std::vector<Measurement>& renders);
};

/// A strategy whose intervals certainly hold less often than they say.
struct SelfFailure {
  std::size_t strategy = 0;
  std::uint64_t inside = 0, total = 0;
  std::array<std::uint64_t, 2> pixel = {};  // most often the worst of the others
  double worst_share = 0;  // of their error, in the worst kWorstShare of their pixels
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
  std::string image;  // name, of the first repetition; empty: none

  bool ReferenceLimited() const { return reference_share > 0.5; }
};

/// Test of equal means by tile.
struct TileTest {
  TileLayout layout;
  std::vector<double> z;  // signed, normal if the means are equal; NaN: not testable
  /// By Holm's correction over the tiles; after TestBias without those that are `shared`.
  std::vector<std::size_t> failed;
  /// Differ from the reference as the other strategies do.
  std::vector<std::size_t> shared;
  /// Of the tiles: all repetitions together, and the reference.
  std::vector<stat::MeanEstimate> means, reference;
  double level = 0;  // of all tiles together
};

struct StrategyAnalysis {
  std::vector<LevelAnalysis> levels;
  std::vector<stat::Level> costs;    // relative MSE and processor seconds by level
  std::vector<stat::Level> squares;  // MSE and processor seconds by level
  std::vector<stat::Cost> trimmed;   // trimmed relative MSE, at the level `at`
  std::size_t at = 0;                // index of the level that comparisons are at
  /// Slopes over log samples of log RMSE, and of log sqrt(relative MSE): they differ
  /// where dark and bright pixels converge at different rates.
  std::optional<Interval> order, order_relmse;
  std::optional<stat::TargetCost> to_target;
  std::optional<Interval> efficiency;
  std::optional<Interval> efficiency_trimmed;  // of Measurement::relmse_trimmed
  /// Standard deviation of the logarithm of the efficiency at equal time, because the
  /// budget's sample counts are measured; in the intervals of both efficiencies.
  double budget_doubt = 0;
  stat::RankRange rank;
  stat::MeanEstimate image_mean;  // of all pixels and repetitions at the level `at`
  bool heavy_tailed = false;
  std::vector<StageProfile> stages;
  SelfRenders self;
  std::optional<TileTest> tiles;
  std::string mean, one, variance, bias;  // names of images; empty: none

  bool HasRuns() const { return !levels.empty(); }
  const LevelAnalysis& AtLevel() const { return levels[at]; }
};

struct SceneAnalysis {
  std::vector<StrategyAnalysis> strategies;  // as SceneRuns::strategies
  std::vector<std::size_t> ranking;          // with runs, most efficient first
  std::size_t baseline = 0;
  double target_relmse = 0;
  SelfCheck calibration;
  /// Share of the intervals that held; renders of one seed depend on each other, whatever
  /// their strategies.
  Interval calibration_share;
  std::size_t calibration_seeds = 0;
  std::vector<SelfFailure> self_failures;
  std::size_t bias_tests = 0;
  /// Strategies whose whole image differs from the reference, by Holm: those that differ
  /// from the other strategies too, and those that do as these, which points at it.
  std::vector<std::size_t> biased, biased_alike;
  std::vector<std::size_t> suspect_tiles;  // TileTest::shared of any strategy
  double bias_level = 0;
  std::string verdict;
  std::vector<std::string> cautions;  // Cautions()
  std::vector<MachineInfo> machines;  // that rendered the cells
  std::string reference_image;        // name
  std::vector<std::string> diffuse_images;
  int report_scale = 1;  // the report's images are smaller by this factor
};

/// Share of the relative MSE in the worst kWorstShare of the pixels above which a
/// strategy counts as heavy-tailed: a few pixels then decide the mean.
inline constexpr double kHeavyTail = 0.3;

/// Names that a reader takes in.
inline constexpr std::size_t kMostNames = 4;

/// Share of the reference's own error above which it would decide whether an interval
/// holds.
inline constexpr double kMostReferenceShare = 0.1;

/// Analyses a scene, reading its cells from the disk, and collects the images.
SceneAnalysis AnalyseScene(const SceneRuns& runs, const StudyOptions& options,
                           std::vector<ReportImage>& images);

/// The parts of it.
LevelAnalysis AnalyseLevel(const Cells& cells, const Reference& reference,
                           std::uint64_t spp, double confidence);
stat::MeanEstimate ImageMean(const Moments& moments);
/// After the strategies have their levels: ranking, efficiencies, ranks.
void CompareStrategies(const SceneRuns& runs, const StudyOptions& options,
                       SceneAnalysis& analysis);
stat::MeanEstimate ReferenceMean(const Reference& reference);
/// After the strategies have their tiles. An error of the reference is in the comparison
/// of every strategy with it: what differs from the reference, does not differ from the
/// consensus of the other strategies, and is not in it alone, points at the reference.
/// Heavy-tailed strategies are not tested.
void TestBias(const Reference& reference, SceneAnalysis& analysis);
/// `moments` of renders of `spp` samples per pixel.
TileTest TestTiles(const Moments& moments, const Reference& reference, std::uint64_t spp,
                   double level);
/// After the strategies have their levels and renders: how often intervals held.
void Calibrate(double confidence, SceneAnalysis& analysis);
/// Sentences about that; may be empty.
std::string CalibrationText(const SceneRuns& runs, const SceneAnalysis& analysis);
std::string Verdict(const SceneRuns& runs, const SceneAnalysis& analysis);
/// Why the ranking may be another than that of long renders on a quiet machine, one
/// sentence each: its sample count is small, ranks change between sample counts, or the
/// load of the machine exceeds its cores.
std::vector<std::string> Cautions(const SceneRuns& runs, const StudyOptions& options,
                                  const SceneAnalysis& analysis);
/// The verdict's sentences about bias; may be empty.
std::string BiasText(const SceneRuns& runs, const SceneAnalysis& analysis);
/// Puts a sentence, which may be empty, behind what there is.
void AddSentence(const std::string& sentence, std::string& text);
/// "A, B and C"; "7 strategies" of more than `most`.
std::string NamesText(const SceneRuns& runs, const std::vector<std::size_t>& strategies,
                      std::size_t most = kMostNames);

}  // namespace lanelight
