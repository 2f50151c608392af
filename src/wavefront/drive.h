// The loop of one task: runs the planned stages until its samples are done.
#pragma once

#include <vector>

#include "src/wavefront/run.h"
#include "src/wavefront/wavefront.h"

namespace lanelight {

/// Per-stage counters of one thread, in the order of Plan::stages.
struct StageCounters {
  std::uint64_t calls = 0, items = 0, lane_slots = 0;
  std::int64_t nanoseconds = 0;
};

/// Runs `work` to the end on `wavefront`, writing finished samples to `buffer`.
/// `counters` has one entry per stage, or is empty when nothing is to be timed.
void Drive(Wavefront& wavefront, const Plan& plan, const TileWork& work,
           const SampleBuffer& buffer, std::vector<StageCounters>& counters);

}  // namespace lanelight
