// The passes of decide=pilot: what each strategy that may be chosen learns, costs and
// scatters, all on the same pixels (src/wavefront/train_decision.cc).
#pragma once

#include <optional>
#include <string>

#include "src/wavefront/pilot_comparison.h"
#include "src/wavefront/stop_watcher.h"
#include "src/wavefront/training.h"
#include "src/wavefront/training_pass.h"

namespace lanelight {

/// A strategy that may be chosen.
struct DecisionEntry {
  std::string name;     // as a candidate has it; empty: the strategy as given
  std::string changes;  // in full
  double margin = 1;    // DecisionCandidate::margin
  PlanOptions options;
  StrategyTables tables;
  PilotMeasure measure;  // of its own pass
  bool paired = false;   // its paths have told of `usual` as well
  PilotMeasure usual;    // of the strategy as given: what `measure` is compared with
};

class DecisionPilot {
 public:
  /// Passes of about so many samples.
  DecisionPilot(const TrainingContext& context, std::uint64_t samples);

  /// What the strategy of an entry learns beforehand, for so many planned samples.
  TrainingOutcome Learn(const DecisionEntry& entry, std::uint64_t planned,
                        StrategyTables& tables);
  /// Renders the pixels with what an entry has learned, and fills its measures. The first
  /// entry is the strategy as given, `usual`. False: the user has stopped it.
  bool Measure(DecisionEntry& entry, const DecisionEntry& usual);

  bool Stopped() const { return training_.stop != nullptr && *training_.stop; }
  /// Of one pass.
  std::uint64_t samples() const { return work_.samples(); }
  /// Samples and rays of all passes so far.
  const TrainingOutcome& spent() const { return spent_; }

 private:
  bool RecordsUnsplit(const DecisionEntry& entry, const DecisionEntry& usual) const;
  TrainingSamples Render(const DecisionEntry& entry, bool records);

  const CompiledScene& scene_;
  const RunParameters& run_;
  const TrainingOptions& training_;
  const StopWatcher watcher_;
  TrainingWork work_;
  std::optional<ImageGuess> image_;
  TrainingOutcome spent_;
};

}  // namespace lanelight
