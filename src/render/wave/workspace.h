// Memory that a run keeps between tasks.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/render/plan/plan_features.h"
#include "src/render/wave/block_reuse.h"
#include "src/render/wave/run_state.h"
#include "src/render/wave/seen_lights.h"
#include "src/render/wave/stage_clock.h"
#include "src/render/wave/wavefront.h"

namespace lanelight {

/// Samples of one finished task, until they are merged in order.
struct TaskSamples {
  AlignedVector<float> values;
  std::uint32_t count = 0;  // samples per pixel; 0 = not run
  RunCounts counts;
};

/// What a thread keeps between tasks.
struct Workspace {
  Workspace(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
            const RunOptions& options)
      : wavefront(scene, plan, run) {
    if (options.profile) {
      clock.emplace(plan.rows(), options.profiling);
    }
    if (plan.features.Has(Feature::kReuse)) {
      reuse.emplace(plan, PlannedStrategy(scene, plan.options));
    }
    if (plan.Find(PhaseId::kVisibleLights))
      seen_lights.emplace(scene, plan, run, wavefront);
  }
  /// Null if nothing is timed.
  StageClock* Clock() { return clock ? &*clock : nullptr; }

  Wavefront wavefront;
  std::optional<BlockReuse> reuse;
  std::optional<SeenLightRays> seen_lights;
  std::optional<StageClock> clock;
  std::vector<std::uint32_t> pixels;
  TaskSamples samples;
};

}  // namespace lanelight
