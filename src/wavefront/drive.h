// The loop of one task: runs the planned stages until its samples are done.
#pragma once

#include "src/wavefront/stage_clock.h"
#include "src/wavefront/wavefront.h"

namespace lanelight {

/// Runs `work` to the end on `wavefront`, writing finished samples to `buffer`. `clock`
/// times the stages; null: nothing is timed.
void Drive(Wavefront& wavefront, const Plan& plan, const TileWork& work,
           const SampleBuffer& buffer, StageClock* clock);

}  // namespace lanelight
