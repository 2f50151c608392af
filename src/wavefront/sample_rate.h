// How many samples a time budget is enough for, before the render has begun.
#pragma once

#include <cstdint>

#include "src/path/run_parameters.h"
#include "src/wavefront/plan.h"

namespace lanelight {

class TaskWatcher;  // src/wavefront/task_watcher.h

/// By the speed of a few thousand samples with roulette on the throughput, in this
/// process; rounded down to a power of two, so that runs on one machine mostly agree. At
/// least 1. It takes about 20 ms.
std::uint64_t SamplesWithin(double seconds, const CompiledScene& scene,
                            const PlanOptions& options, const RunParameters& run,
                            const TaskWatcher* watcher);

}  // namespace lanelight
