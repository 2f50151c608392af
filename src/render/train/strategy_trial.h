// The trial of strategies on the same pixels of decide=pilot: what each learns, costs and
// scatters. It depends on scene, settings and seed alone: costs are counted in rays.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/render/train/training.h"
#include "src/render/train/training_pass.h"
#include "src/render/train/trial_comparison.h"
#include "src/render/wave/task_watcher.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {

/// A change of the strategy that may be more efficient.
struct DecisionCandidate {
  const char* changes;  // as in --strategy
  /// Processor time of a counted ray (TrainingSamples::Cost) over that without the
  /// change. Its logarithm scatters by 0.1 to 0.3 from scene to scene.
  double price;
};

/// Least gain for which a change is chosen: a wrong change costs more than a missed one.
inline constexpr double kMinChangeGain = 1.05;

// Costs are counted in rays, so that a choice depends on the scene only; prices make
// up for what rays do not say. They are means over 32 scenes, 96 pixels wide, 64 spp, one
// thread, AVX-512. What a sample costs beside its rays and what a shadow ray costs have
// no part in them: with a constant per sample, or other weights of shadow rays, they
// scatter as much.
//
// Left out: directions=bsdf and light, which differ from combining both most in rare
// bright samples that a trial does not see, and gain 1.3 at most (Veach and Guibas 1995:
// combining is never much worse than either, one alone can be), and what has never won:
// control variates (0.35 to 0.98), uniform directions, antithetic pairs, which undo what
// strata gain, a constant roulette.
inline constexpr DecisionCandidate kRouletteCandidates[] = {
    {"roulette=adjoint", 1.17},
    {"roulette=throughput:0:2:4", 1.0},
};
inline constexpr DecisionCandidate kLearnedSelection = {"light-selection=learned", 1.04};

/// Changes that are tried on whole tiles, beside what has been chosen. (Prices of light
/// subpaths: 18 scenes, 128 x 96 pixels.)
inline constexpr DecisionCandidate kTileCandidates[] = {
    {"reuse=block", 1.2},
    {"reuse=block:32", 1.2},
    {"light-paths=splats", 1.31},
    {"light-paths=splats:1", 1.54},
};

/// The image's light by one pass, pixels weighted as in relative errors.
struct TrialLight {
  double sum = 0, standard_error = 0;
};

/// A strategy that may be chosen.
struct TriedStrategy {
  std::string changes;  // of the baseline strategy, which has none
  double price = 1;     // DecisionCandidate::price
  PlanOptions options;
  Strategy strategy;  // of `options`
  StrategyTables tables;
  bool has_learned = false;
  /// Its paths live longer than those of the baseline strategy, and nothing else differs.
  /// A path that survives with a higher probability is divided by a larger number, so no
  /// sample varies more.
  bool milder_roulette = false;
  /// It only selects lights differently, and each with at least a tenth of its
  /// probability by power: a sample is at most ten times as bright.
  bool is_bounded = false;
  TrialMeasure measure;   // of its own pass
  bool paired = false;    // its paths have told of `baseline` as well
  TrialMeasure baseline;  // of the baseline strategy: what `measure` is compared with
  TrialLight light, baseline_light;

  /// Returns whether it finds clearly less light than the baseline strategy: the rest
  /// comes in bright samples too rare to be seen, so its variance is underestimated.
  bool MissesLight() const;
  /// Returns whether few pixels carry its error: more samples would find others, brighter
  /// ones too, whose share is unknown. A pair does not help: a bright sample that copies
  /// repeat is in both measures.
  bool IsCarriedByFew() const;
  /// Returns whether few pixels carry its error or the baseline one's, although it varies
  /// no more (`milder_roulette`): then all other pixels decide.
  bool IgnoresWorstPixels() const;

  /// Returns its efficiency relative to the baseline strategy: over all pixels, or
  /// without the worst thousandth if these pixels are ignored.
  TrialGain EfficiencyGain() const;
  /// Returns the least gain without any one pixel and, unless it is paired, without the
  /// worst thousandth.
  TrialGain Gain() const;
  /// Returns the logarithm of its gain over `must_gain` if that is clear by so many
  /// standard errors, and it neither misses light nor is carried by few pixels; else 0.
  double SignificantLogGain(double must_gain, double standard_errors) const;
};

/// Prepares a change of the strategy of `options` for a trial. Strategies that are tried
/// together have the same scene and view.
TriedStrategy PrepareTrial(const PreparedScene& scene, const PlanOptions& options,
                           const std::string& changes, double price);

/// Result of a change on whole tiles, beside a strategy.
struct TriedOnTiles {
  DecisionCandidate candidate;
  /// Relative efficiency by pixels, and by squares of 8 x 8 pixels: errors of the pixels
  /// of a block have much in common, so a filter removes less of them.
  TrialGain per_pixel, filtered;
  bool has_gain_per_pixel = false, is_efficient = false;

  /// Returns the logarithm of the geometric mean of both gains, without the best tile and
  /// square of each.
  double LogJointGain() const;
  /// Sets `has_gain_per_pixel` if the gain by pixels is more than `must_gain` and clear,
  /// also without any one tile; and `is_efficient` if nothing is clearly lost by squares
  /// either.
  void Judge(double must_gain);
};

/// Returns the first efficient one, or a later one whose joint gain is clearly larger;
/// null if none is efficient.
const TriedOnTiles* BestOf(const std::vector<TriedOnTiles>& tried);

class StrategyTrial {
 public:
  /// Strategies learn as for a render of `planned` samples. Keeps references to scene and
  /// training.
  StrategyTrial(const PreparedScene& scene, const TrainingOptions& training,
                std::uint32_t seed, std::uint64_t planned);

  /// Renders about so many samples of each strategy from here on, 32 in each pixel.
  void Begin(std::uint64_t samples);
  /// Trains the strategy if needed, renders the pixels and fills its measures. The first
  /// one tried is the baseline strategy. Returns false if the user has stopped it.
  bool Try(TriedStrategy& tried, const TriedStrategy& baseline);

  /// Tries kTileCandidates beside the chosen strategy, whose efficiency relative to the
  /// baseline one is `gain`. Where the chosen one splits paths, they take its place
  /// beside the baseline one if they gain more; where both split, nothing is tried.
  ///
  /// Renders about this many samples of whole tiles with each. Omits what the scene or
  /// the strategy refuses, blocks of 32 unless 64 gain by pixels and lose after a filter,
  /// and all after an interrupt.
  std::vector<TriedOnTiles> TryOnTiles(const TriedStrategy& baseline,
                                       const TriedStrategy& chosen, double gain,
                                       std::uint64_t samples);

  /// Trains the strategy for so many planned samples.
  TrainingOutcome TrainStrategy(const TriedStrategy& tried, std::uint64_t planned,
                                StrategyTables& tables);

  bool IsStopped() const { return watcher_.IsStopped(); }
  /// Returns the samples of one pass.
  std::uint64_t samples() const { return work_.samples(); }
  /// Returns samples and rays of all passes so far.
  const TrainingOutcome& spent() const { return spent_; }

 private:
  TrainingSamples Render(const TriedStrategy& tried, const PlanOptions& options,
                         const TrainingWork& work, const PilotImage* image = nullptr);
  void LearnEmission(const PlanOptions& options, TriedStrategy& tried);
  bool MayUse(const TriedStrategy& beside, const char* changes) const;
  void Measure(TriedStrategy& tried, const TriedStrategy& baseline);
  TrialLight LightOf(const TrainingSamples& samples, const TrialMeasure& measure) const;

  const PreparedScene& scene_;
  const TrainingOptions& training_;
  const std::uint32_t seed_;
  const std::uint64_t planned_;
  const StopWatcher watcher_;
  TrainingWork work_;
  std::optional<PilotImage> image_;
  TrainingOutcome spent_;
};

}  // namespace lanelight
