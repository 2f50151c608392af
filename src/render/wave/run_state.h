// The state of a run between tasks: all that is needed to resume it, here or elsewhere.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/column.h"
#include "src/render/wave/films.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// Counts of a run. All but the seconds are the same for any split of the work.
struct RunCounts {
  std::uint64_t samples = 0, rays_closest = 0, rays_shadow = 0;
  Health health;
  double seconds = 0, cpu_seconds = 0;  // training included

  void Add(const RunCounts& more) {
    samples += more.samples;
    rays_closest += more.rays_closest;
    rays_shadow += more.rays_shadow;
    health.nan += more.health.nan;
    health.infinite += more.health.infinite;
    health.negative += more.health.negative;
    seconds += more.seconds;
    cpu_seconds += more.cpu_seconds;
  }
};

/// Samples of one finished task, until they are merged in order.
struct TaskSamples {
  AlignedVector<float> values;
  std::uint32_t count = 0;         // samples per pixel; 0 = not run
  std::vector<PixelSplat> splats;  // of light subpaths, with kLightPaths
  std::uint64_t light_paths = 0;   // number of these
  RunCounts counts;
  double cpu_seconds = 0;  // if the run has a profile; not part of `counts`
};

/// Numbers that a training has learned, by name.
struct TrainedTable {
  std::string name, meaning;
  std::vector<double> values;
};

/// The result of the training before the image (src/render/train/training.h).
struct TrainingOutcome {
  /// Changes of the strategy, as in --strategy, that the image is rendered with; may be
  /// empty.
  std::string changes;
  std::string note;  // what was found, one line
  /// Efficiency of a strategy that a trial run has chosen over the given one, by pixels
  /// and after a filter of 8 x 8 pixels; 0 if it has chosen none.
  double gain = 0, filtered_gain = 0;
  std::uint64_t samples = 0, rays = 0;
  double seconds = 0, cpu_seconds = 0;
};

/// Results of a run so far, besides its films.
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

/// Stores the state of a running run.
class Checkpointer {
 public:
  virtual ~Checkpointer() = default;
  /// Called before the run begins. Returns true if it has loaded a state to resume from;
  /// the films' columns then hold its samples.
  virtual bool Restore(RunState& state) = 0;
  /// Returns whether Keep is due; called often, from any thread. Tasks in flight are then
  /// finished, and others wait.
  virtual bool IsDue() const = 0;
  /// Keeps the state. No task is in flight; pixels may have different numbers of samples.
  virtual void Save(RunState& state) = 0;
};

}  // namespace lanelight
