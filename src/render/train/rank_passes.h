// Training by several ranks: all run the same training, each renders its share of the
// tasks of every pass, and all receive all samples. All ranks so learn and decide the
// same.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "src/base/core/rank_group.h"
#include "src/render/train/training_pass.h"
#include "src/render/wave/task_watcher.h"

namespace lanelight {

class RankPasses {
 public:
  /// `signal`: RunOptions::stop of this rank. Keeps references to both.
  RankPasses(RankGroup& group, const std::atomic<bool>* signal)
      : group_(group), signal_(signal) {}

  /// Returns the flag for TrainingOptions::stop, which is set on all ranks in the same
  /// pass, after a signal to any of them.
  const std::atomic<bool>* stop() const { return &stop_; }
  /// Returns the watcher of a pass's tasks: a signal to this rank.
  const TaskWatcher& watcher() const { return signal_; }

  bool Renders(std::size_t task) const {
    return task % std::size_t(group_.ranks()) == std::size_t(group_.rank());
  }
  /// Exchanges the samples of all tasks; collective. Task t has those from begins[t] to
  /// begins[t + 1].
  void Exchange(const std::vector<std::size_t>& begins, TrainingSamples& samples);

 private:
  struct Head;

  Head OwnHeader(const TrainingSamples& samples) const;
  std::string OwnPart(const std::vector<std::size_t>& begins,
                      const TrainingSamples& samples) const;

  RankGroup& group_;
  const StopWatcher signal_;
  std::atomic<bool> stop_{false};
};

}  // namespace lanelight
