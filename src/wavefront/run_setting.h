// What the parts of a run (run_watch.h, error_looks.h, run_parts.h) work on.
#pragma once

#include <atomic>
#include <cstdint>

#include "src/compiled/scene.h"
#include "src/wavefront/crew.h"
#include "src/wavefront/films.h"
#include "src/wavefront/run.h"
#include "src/wavefront/run_clock.h"
#include "src/wavefront/tasks.h"

namespace lanelight {

/// Windows are cut from an image whose other pixels nobody knows: their pixels all have
/// as many samples, with allocation=error too.
inline bool Allocates(const CompiledScene& scene, const RunOptions& options) {
  return scene.strategy.allocation == Allocation::kError && options.windows.empty();
}

/// By a signal, to this process or another one.
inline bool Interrupted(const RunOptions& options, const Crew& crew) {
  const std::atomic<bool>* const stop = options.stop;
  return (stop != nullptr && stop->load(std::memory_order_relaxed)) || crew.Stopped();
}

struct RunSetting {
  const CompiledScene& scene;
  const RunOptions& options;
  Crew& crew;
  const RunClock& clock;
  Tasks& tasks;
  Films& films;

  /// Pixels differ in their samples after a pilot (src/wavefront/allocation.h).
  bool allocates() const { return Allocates(scene, options); }
  /// Samples per pixel at most.
  std::uint64_t limit() const {
    return options.spp > 0 ? options.spp : kMostSamplesPerPixel;
  }
  /// Samples that belong together.
  std::uint32_t unit() const { return films.film().groups().unit; }
};

}  // namespace lanelight
