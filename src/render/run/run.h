// Runs a plan: distributes (tile x sample range) tasks over threads, each with its own
// wavefront, and gathers the film.
#pragma once

#include "src/base/core/rank_group.h"
#include "src/render/plan/plan.h"
#include "src/render/wave/run_options.h"
#include "src/render/wave/run_result.h"

namespace lanelight {

/// Renders into `film`, without samples but those that options.checkpointer goes on from:
/// its size must match the crop window of the scene, or the strip of options.windows, its
/// groups the strategy (src/scene/prepare/parameters.h).
RunResult Run(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film);

/// Renders for the leader of options.group until it ends the run. `film` receives the
/// worker's part of the image only; the leader decides how much is rendered, and keeps
/// the state.
void ServeRun(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film);

}  // namespace lanelight
