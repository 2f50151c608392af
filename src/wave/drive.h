// The loop of one task: waves of stages until all of its samples are done.
#pragma once

#include "src/plan/plan.h"
#include "src/wave/stage_clock.h"
#include "src/wave/task_watcher.h"
#include "src/path/wave.h"

namespace lanelight {

/// Samples of a pixel in adjacent slots of a plan's wavefront: their rays share more of
/// the scene than those of neighbouring pixels. Never more than it has slots; even where
/// samples come in pairs.
std::uint32_t SamplesTogether(const PreparedScene& scene, const Plan& plan);

/// Samples to take, and where finished ones go.
struct DriveTask {
  TileWork work;
  SampleBuffer buffer;
  bool seen_lights = false;  // by Plan::seen_stages alone
};

/// The loop of one task: runs it to the end on `wave`, whose columns are those of the
/// plan, or of its seen_features. `clock` times the stages; null: nothing is timed.
/// Returns false if the watcher has cancelled it; then the buffer is of no use. Null:
/// nobody does.
bool Drive(Wave& wave, const Plan& plan, const DriveTask& task, StageClock* clock,
           const TaskWatcher* watcher = nullptr);

}  // namespace lanelight
