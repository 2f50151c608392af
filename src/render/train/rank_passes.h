// Training by several ranks in step: all run the same training, each renders its share of
// the tasks of every pass, and all have the samples of all of them. What is learned from
// them, and decided by them, is then the same on each.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "src/base/core/rank_group.h"
#include "src/render/train/training_pass.h"
#include "src/render/wave/stop_watcher.h"

namespace lanelight {

class RankPasses {
 public:
  /// `signal` as RunOptions::stop of this rank. Refers to both.
  RankPasses(RankGroup& group, const std::atomic<bool>* signal)
      : group_(group), signal_(signal) {}

  /// Set on all ranks alike, in the pass in which a signal has come to any of them: what
  /// TrainingOptions::stop is to be, so that they stop at the same place.
  const std::atomic<bool>* stop() const { return &stop_; }
  /// Of the tasks of a pass: a signal to this rank.
  const TaskWatcher& watcher() const { return signal_; }

  bool Renders(std::size_t task) const {
    return task % static_cast<std::size_t>(group_.ranks()) ==
           static_cast<std::size_t>(group_.rank());
  }
  /// Collective: samples of all tasks, of which each rank has its own. Task t has those
  /// from begins[t] to begins[t + 1].
  void Exchange(const std::vector<std::size_t>& begins, TrainingSamples& samples);

 private:
  struct Head;

  Head OwnHead(const TrainingSamples& samples) const;
  std::string OwnPart(const std::vector<std::size_t>& begins,
                      const TrainingSamples& samples) const;

  RankGroup& group_;
  const StopWatcher signal_;
  std::atomic<bool> stop_{false};
};

}  // namespace lanelight
