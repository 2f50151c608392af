// What the parts of a run (run_watch.h, convergence_checks.h, run_parts.h) work on.
#pragma once

#include <cstdint>

#include "src/render/run/group_tasks.h"
#include "src/render/run/run.h"
#include "src/render/run/tasks.h"
#include "src/render/wave/films.h"
#include "src/render/wave/run_clock.h"

namespace lanelight {

struct RunSetting {
  const RunOptions& options;
  const RunClock& clock;
  Tasks& tasks;
  Films& films;
  GroupTasks& work;

  /// Samples per pixel at most.
  std::uint64_t limit() const {
    return options.spp > 0 ? options.spp : kMostSamplesPerPixel;
  }
  /// Samples that belong together.
  std::uint32_t unit() const { return films.film().groups().unit; }
};

}  // namespace lanelight
