// The strategy that a run renders with: the plan, the parameters of kernels, the tables;
// and the training before the image, which fills the tables and may change the strategy.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/rank_group.h"
#include "src/render/run/run.h"
#include "src/render/train/training.h"
#include "src/render/wave/run_clock.h"
#include "src/render/wave/run_state.h"

namespace lanelight {

/// The seed of kernels, of a render's seed: another one after each kSamplesPerSeed
/// samples.
std::uint32_t SeedOf(std::uint64_t seed, std::uint64_t first_sample);

class RunStrategy {
 public:
  /// Refers to all but the plan for as long as it lives.
  RunStrategy(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
              const RunClock& clock);
  // Others refer to plan and parameters.
  RunStrategy(const RunStrategy&) = delete;
  RunStrategy& operator=(const RunStrategy&) = delete;

  const Plan& plan() const { return plan_; }
  const RunParameters& run() const { return run_; }
  /// Sets the seed of the kernels for rounds from this sample on.
  void BeginWith(std::uint64_t first);

  /// Samples that a training is planned for; 0 if the strategy asks for none.
  std::uint64_t PlannedTraining() const;
  /// Trains for so many, all ranks of the group together. What a signal cuts short does
  /// not count.
  void Train(std::uint64_t planned, RankGroup& group);
  /// Takes what has been learned before. Throws InputError for tables that kernels must
  /// not be given, and for changes to the strategy that there are not.
  void Restore(TrainingOutcome training, const std::vector<TrainedTable>& tables);

  /// What follows has been learned to the end, and the image is rendered with it.
  bool trained() const { return trained_; }
  const TrainingOutcome& training() const { return training_; }
  /// Empty if not trained().
  std::vector<TrainedTable> Tables() const;
  /// SampleGroups::dependents of what is rendered: after training.
  double Dependents() const;
  /// Says in a result which strategy it was, and what the training has cost.
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
