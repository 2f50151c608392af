// A run at rest: what it needs to go on, here or elsewhere, as if it had never stopped.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/core/column.h"
#include "src/render/wave/films.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// What has been counted. All but the seconds are the same however the work was cut.
struct RunCounts {
  std::uint64_t samples = 0, rays_closest = 0, rays_shadow = 0;
  Health health;
  double seconds = 0, cpu_seconds = 0;  // training included

  void Add(const RunCounts& more);
};

/// Numbers that a training has learned, by name.
struct TrainedTable {
  std::string name, meaning;
  std::vector<double> values;
};

/// What a strategy has learned before the image (src/render/train/training.h).
struct TrainingOutcome {
  /// To the strategy, as in --strategy, with which the image is to be rendered; empty:
  /// none.
  std::string changes;
  std::string note;  // what was found, one line
  std::uint64_t samples = 0, rays = 0;
  double seconds = 0, cpu_seconds = 0;

  /// Another training's, after this one: all of its changes, notes and counts count.
  void Add(const TrainingOutcome& next);
};

/// What a run has done, beside its films.
struct RunRecord {
  RunCounts counts;
  bool trained = false;  // what follows is of a training
  TrainingOutcome training;
  std::vector<TrainedTable> tables;
};

struct RunState : RunRecord {
  Films& films;
  bool finished = false;  // to the run's own end, not to a signal
};

/// Keeps the state of a run while it goes on.
class RunKeeper {
 public:
  virtual ~RunKeeper() = default;
  /// Called before the run begins. True: the state is that of a run to be gone on with;
  /// the films' columns then hold its samples.
  virtual bool Restore(RunState& state) = 0;
  /// Called often, from any thread: whether Keep is due, true until it is called. Tasks
  /// that have begun are finished then, and others wait.
  virtual bool Due() const = 0;
  /// Nothing is in flight; every pixel has a whole number of samples, not all the same.
  virtual void Keep(RunState& state) = 0;
};

}  // namespace lanelight
