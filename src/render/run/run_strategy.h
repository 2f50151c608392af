// The strategy that a run renders with: the plan, the parameters of kernels, the tables;
// and the training before the image, which fills the tables and may change the strategy.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/rank_group.h"
#include "src/render/run/run.h"
#include "src/render/schedule/thread_work.h"
#include "src/render/train/training.h"
#include "src/render/wave/run_options.h"
#include "src/render/wave/run_state.h"

namespace lanelight {

/// Returns the seed of kernels for a render's seed; it changes after each kSamplesPerSeed
/// samples.
std::uint32_t SeedOf(std::uint64_t seed, std::uint64_t first_sample);

class RunStrategy {
 public:
  /// Keeps references to all but the plan.
  RunStrategy(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
              const RunClock& clock);
  // Not copied: others refer to plan and parameters.
  RunStrategy(const RunStrategy&) = delete;
  RunStrategy& operator=(const RunStrategy&) = delete;

  const Plan& plan() const { return plan_; }
  const RunParameters& run() const { return run_; }
  /// Sets the seed of the kernels for rounds from this sample on.
  void SetFirstSample(std::uint64_t first);

  /// Returns the samples that a training is planned for; 0 if the strategy needs none.
  std::uint64_t PlannedTraining() const;
  /// Trains on all ranks of the group together. Training that a signal interrupts does
  /// not count.
  void Train(std::uint64_t planned, RankGroup& group);
  /// Loads the result of an earlier training. Throws InputError for tables that kernels
  /// cannot use, and for unknown changes of the strategy.
  void Restore(TrainingOutcome training, const std::vector<TrainedTable>& tables);

  /// Returns whether training was completed, and the image uses it.
  bool trained() const { return trained_; }
  const TrainingOutcome& training() const { return training_; }
  /// Returns the trained tables; empty if not trained().
  std::vector<TrainedTable> Tables() const;
  /// Returns SampleGroups::dependents of the strategy after training.
  double Dependents() const;
  /// Stores the strategy and the cost of training in a result.
  void Describe(RunResult& result) const;

 private:
  void UseTraining();
  RunParameters Parameters() const;

  const PreparedScene& scene_;
  Plan plan_;
  const RunOptions& options_;
  const RunClock& clock_;
  StrategyTables tables_;
  RunParameters run_;
  TrainingOutcome training_;
  bool trained_ = false;
};

}  // namespace lanelight
