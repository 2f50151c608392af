// What a run counted: stages, rays, invalid samples, memory.
#pragma once

#include <vector>

#include "src/wavefront/drive.h"
#include "src/wavefront/run.h"

namespace lanelight {

/// One profile per stage of the plan, in its order, without counts.
std::vector<StageProfile> EmptyProfiles(const Plan& plan);

/// Adds what one thread's wavefront has counted. `counters`: as for Drive().
void AddCounts(Wavefront& wavefront, const std::vector<StageCounters>& counters,
               RunResult& result);

}  // namespace lanelight
