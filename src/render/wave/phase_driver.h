// Runs the stages of a phase of a plan.
#pragma once

#include "src/render/plan/plan.h"
#include "src/render/wave/stage_clock.h"
#include "src/render/wave/task_watcher.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// Runs a phase to its end on `wave`, whose columns are those of the phase's features and
/// whose work, buffer and queues are set. `clock` times the stages; null: nothing is
/// timed. Returns false if the watcher (null: none) has cancelled it; then the samples
/// are of no use.
bool RunPhase(Wave& wave, const Phase& phase, StageClock* clock,
              const TaskWatcher* watcher = nullptr);

}  // namespace lanelight
