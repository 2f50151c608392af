// Profiles of a run: stages, rays, invalid samples, memory.
#pragma once

#include <vector>

#include "src/render/wave/run_options.h"
#include "src/render/wave/run_result.h"
#include "src/render/wave/stage_clock.h"
#include "src/render/wave/wavefront.h"

namespace lanelight {

/// Returns the group of a stage of a phase.
ProfileGroup GroupOf(PhaseId phase, const Stage& stage);

/// One profile per stage of the plan, in its order, without counts.
std::vector<StageProfile> EmptyProfiles(const Plan& plan);

/// Returns one profile per TaskPart, without counts.
std::vector<StageProfile> EmptyParts();

/// Adds profiles of another run to those of the same names.
void AddStages(const std::vector<StageProfile>& more, std::vector<StageProfile>& sum);

/// Adds the memory of one thread's wavefront and what its clock has counted; the clock
/// gives its trace away. `clock` may be null.
void AddCounts(Wavefront& wavefront, StageClock* clock, int lanes, RunResult& result);

}  // namespace lanelight
