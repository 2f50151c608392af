// Who renders the rounds of a run: the threads of this process (thread_work.h), or
// several ranks (src/render/ranks/rank_work.h). A run does not know which.
#pragma once

#include <cstdint>

#include "src/render/schedule/scheduler.h"
#include "src/render/wave/run_state.h"
#include "src/render/wave/task_watcher.h"

namespace lanelight {

class RoundRunner {
 public:
  virtual ~RoundRunner() = default;

  /// Brings all tiles to the end of the round, unless the watcher stops it. A range that
  /// was cancelled is as if it had not begun. Throws what a task has thrown.
  virtual void RunRound(const Round& round, TaskWatcher& watcher) = 0;
  /// Brings all samples into the films and into Counts().
  virtual void Gather() {}
  /// Levels of all tiles, after a round.
  virtual TileLevels Levels() const = 0;
  /// Counts of the samples in the films; excludes seconds of this process.
  virtual RunCounts Counts() const = 0;
  /// Samples of all pixels together, merged or not. Safe from any thread.
  virtual std::uint64_t Taken() const = 0;
  /// Returns whether another process was interrupted or has failed: begin no more rounds.
  virtual bool Stopped() const { return false; }
  /// Ends the work of other processes. Throws RankFailure if one of them has failed.
  virtual void Finish() {}

  /// Samples per pixel that all tiles have.
  std::uint64_t Done() const { return Levels().least; }
  /// Returns whether all tiles have exactly so many samples per pixel.
  bool IsAt(std::uint64_t samples) const {
    const TileLevels levels = Levels();
    return levels.least == samples && levels.most == samples;
  }
};

}  // namespace lanelight
