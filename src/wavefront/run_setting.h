// What the parts of a run (run_watch.h, error_looks.h, run_parts.h) work on.
#pragma once

#include <atomic>
#include <cstdint>

#include "src/wavefront/crew.h"
#include "src/wavefront/films.h"
#include "src/wavefront/run.h"
#include "src/wavefront/run_clock.h"
#include "src/wavefront/tasks.h"

namespace lanelight {

/// By a signal, to this process or another one.
inline bool Interrupted(const RunOptions& options, const Crew& crew) {
  const std::atomic<bool>* const stop = options.stop;
  return (stop != nullptr && stop->load(std::memory_order_relaxed)) || crew.Stopped();
}

struct RunSetting {
  const RunOptions& options;
  Crew& crew;
  const RunClock& clock;
  Tasks& tasks;
  Films& films;

  /// Samples per pixel at most.
  std::uint64_t limit() const {
    return options.spp > 0 ? options.spp : kMostSamplesPerPixel;
  }
  /// Samples that belong together.
  std::uint32_t unit() const { return films.film().groups().unit; }
};

}  // namespace lanelight
