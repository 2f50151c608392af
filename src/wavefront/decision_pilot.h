// A trial of strategies on the same pixels: what each learns, costs and scatters. It
// hangs on scene, settings and seed alone: costs are counted in rays.
#pragma once

#include <optional>
#include <string>

#include "src/wavefront/pilot_comparison.h"
#include "src/wavefront/stop_watcher.h"
#include "src/wavefront/training.h"
#include "src/wavefront/training_pass.h"

namespace lanelight {

/// What a pass found of the image's light, pixels weighed as relative errors weigh them.
struct PilotLight {
  double sum = 0, standard_error = 0;
};

/// What is tried: about so many samples, so many in each pixel; those of each `turn` are
/// of other pixels.
struct PilotSize {
  std::uint64_t samples = 0;
  std::uint32_t spp = 32;
  std::uint64_t turn = 0;
};

/// A strategy that may be chosen.
struct DecisionEntry {
  std::string changes;  // of the usual strategy, which has none
  double price = 1;     // DecisionCandidate::price
  PlanOptions options;
  StrategyTables tables;
  PilotMeasure measure;  // of its own pass
  bool paired = false;   // its paths have told of `usual` as well
  PilotMeasure usual;    // of the usual strategy: what `measure` is compared with
  PilotLight light, usual_light;

  /// Clearly less than the usual strategy has found: what is missing comes in bright
  /// samples too rare to be seen, and so the variance is not seen either.
  bool MissesLight() const;
  /// Few pixels carry its own error: with more samples others would come, brighter ones
  /// too, and of how much they add a pass has seen nothing. A pair is no help: a bright
  /// sample that copies tell of twice is in both measures, and makes them look alike.
  bool IsCarriedByFew() const;

  /// How many times as efficient as the usual one it is: by all pixels, without any one,
  /// and if it is not paired without the worst thousandth, whichever is least.
  PilotGain Gain() const;
  /// The logarithm of its gain over `must_gain`, if that is clear by so many standard
  /// errors, and it neither misses light nor is carried by few; else 0.
  double Beyond(double must_gain, double standard_errors) const;
};

class DecisionPilot {
 public:
  DecisionPilot(const CompiledScene& scene, const TrainingOptions& training,
                std::uint32_t seed, const PilotSize& size);

  /// What the strategy of an entry learns beforehand, for so many planned samples.
  TrainingOutcome Learn(const DecisionEntry& entry, std::uint64_t planned,
                        StrategyTables& tables);
  /// Renders the pixels with what an entry has learned, and fills its measures. The first
  /// entry is the usual strategy. False: the user has stopped it.
  bool Measure(DecisionEntry& entry, const DecisionEntry& usual);

  bool Stopped() const { return training_.stop != nullptr && *training_.stop; }
  /// Of one pass.
  std::uint64_t samples() const { return work_.samples(); }
  /// Samples and rays of all passes so far.
  const TrainingOutcome& spent() const { return spent_; }

 private:
  bool RecordsUnsplit(const DecisionEntry& entry, const DecisionEntry& usual) const;
  RunParameters Parameters(const PlanOptions& options,
                           const StrategyTables& tables) const;
  TrainingSamples Render(const DecisionEntry& entry, bool records);
  PilotLight LightOf(const TrainingSamples& samples,
                     const std::vector<double>& variances) const;

  const CompiledScene& scene_;
  const TrainingOptions& training_;
  const std::uint32_t seed_;
  const StopWatcher watcher_;
  TrainingWork work_;
  std::optional<ImageGuess> image_;
  TrainingOutcome spent_;
};

}  // namespace lanelight
