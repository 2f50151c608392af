// A trial of strategies on the same pixels: what each learns, costs and scatters. Of
// decide=pilot, and of `lanelight advise`. It hangs on scene, settings and seed alone:
// costs are counted in rays.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/render/train/decision_candidates.h"
#include "src/render/train/training.h"
#include "src/render/train/training_pass.h"
#include "src/render/train/trial_comparison.h"
#include "src/render/wave/stop_watcher.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {

/// What a pass found of the image's light, pixels weighed as relative errors weigh them.
struct TrialLight {
  double sum = 0, standard_error = 0;
};

/// A strategy that may be chosen.
struct TriedStrategy {
  std::string changes;  // of the usual strategy, which has none
  double price = 1;     // DecisionCandidate::price
  PreparedScene scene;  // for all of the strategy that is not a change of the plan
  PlanOptions options;
  StrategyTables tables;
  bool has_learned = false;
  /// Its paths live longer than those of the usual strategy, and nothing else differs: a
  /// path that survives with a higher probability is divided by a larger number, so no
  /// sample varies more.
  bool lives_longer = false;
  TrialMeasure measure;  // of its own pass
  bool paired = false;   // its paths have told of `usual` as well
  TrialMeasure usual;    // of the usual strategy: what `measure` is compared with
  TrialLight light, usual_light;

  /// Clearly less than the usual strategy has found: what is missing comes in bright
  /// samples too rare to be seen, and so the variance is not seen either.
  bool MissesLight() const;
  /// Few pixels carry its own error: with more samples others would come, brighter ones
  /// too, and of how much they add a pass has seen nothing. A pair is no help: a bright
  /// sample that copies tell of twice is in both measures, and makes them look alike.
  bool IsCarriedByFew() const;
  /// The same, or of the usual strategy, where it varies no more (`lives_longer`): what
  /// few pixels say against it is chance, and all others tell.
  bool IsToldByTheRest() const;

  /// How many times as efficient as the usual one it is, by all pixels; by all but the
  /// worst thousandth if it is told by the rest.
  TrialGain Told() const;
  /// The same without any one pixel, and if it is not paired without the worst
  /// thousandth, whichever is least.
  TrialGain Gain() const;
  /// The logarithm of its gain over `must_gain`, if that is clear by so many standard
  /// errors, and it neither misses light nor is carried by few; else 0.
  double Beyond(double must_gain, double standard_errors) const;
};

/// A change of the strategy that plans of `options` have, nothing known of it yet. What
/// is tried together has the same scene and view.
TriedStrategy ToTry(const PreparedScene& scene, const PlanOptions& options,
                    const std::string& changes, double price);

/// Paths that serve their block (reuse=block) beside a strategy, and what whole tiles say
/// of them.
struct TriedBlocks {
  const char* changes = "";  // as in --strategy
  bool pays_per_pixel = false, pays = false;
  /// How many times as efficient it is, by pixels and by squares of 8 x 8 of them: errors
  /// of the pixels of a block have much in common, so that a filter takes less away.
  TrialGain gain;
  double per_pixel = 1, filtered = 1;
};

class StrategyTrial {
 public:
  /// Strategies learn as for a render of `planned` samples. Refers to scene and training.
  StrategyTrial(const PreparedScene& scene, const TrainingOptions& training,
                std::uint32_t seed, std::uint64_t planned);

  /// From here on about so many samples are rendered of each strategy, so many in each
  /// pixel; those of each `turn` are of other pixels.
  void Begin(std::uint64_t samples, std::uint32_t spp = 32, std::uint64_t turn = 0);
  /// Has it learn, if it has not yet, renders the pixels and fills its measures. The
  /// first that is tried is the usual strategy. False: the user has stopped it.
  bool Try(TriedStrategy& tried, const TriedStrategy& usual);

  /// Blocks of 64 paths beside a strategy that was tried, with about so many samples of
  /// whole tiles, and of 32 if those pay by pixels and not after a filter: smaller ones
  /// gain less by pixels, and more after a filter. The last is the one to take, if it
  /// pays: clearly by pixels (also without any one tile, tiles being independent), by
  /// more than `must_gain`, and without a loss by squares. None where the scene or the
  /// strategy does not take them, or after an interrupt.
  std::vector<TriedBlocks> TryBlocks(const TriedStrategy& usual, std::uint64_t samples,
                                     double must_gain);

  /// What the strategy learns for so many planned samples.
  TrainingOutcome Learn(const TriedStrategy& tried, std::uint64_t planned,
                        StrategyTables& tables);

  bool Stopped() const { return watcher_.Stopped(); }
  /// Of one pass.
  std::uint64_t samples() const { return work_.samples(); }
  /// Samples and rays of all passes so far.
  const TrainingOutcome& spent() const { return spent_; }

 private:
  TrainingSamples Render(const TriedStrategy& tried, const PlanOptions& options,
                         const TrainingWork& work);
  void Measure(TriedStrategy& tried, const TriedStrategy& usual);
  TrialLight LightOf(const TrainingSamples& samples, const TrialMeasure& measure) const;
  TriedBlocks CompareBlocks(const TriedStrategy& usual, const PlanOptions& blocks,
                            const TrainingWork& work, double must_gain);

  const PreparedScene& scene_;
  const TrainingOptions& training_;
  const std::uint32_t seed_;
  const std::uint64_t planned_;
  const StopWatcher watcher_;
  TrainingWork work_;
  std::optional<ImageGuess> image_;
  TrainingOutcome spent_;
};

}  // namespace lanelight
