// What the schedule and the watch of a run work on.
#pragma once

#include <cstdint>

#include "src/render/run/run.h"
#include "src/render/schedule/thread_work.h"
#include "src/render/wave/films.h"
#include "src/render/wave/run_clock.h"

namespace lanelight {

struct RunContext {
  const RunOptions& options;
  const RunClock& clock;
  Films& films;
  ThreadWork& threads;  // of this process
  RoundRunner& work;    // `threads`, or all ranks

  /// Samples per pixel at most.
  std::uint64_t limit() const {
    return options.spp > 0 ? options.spp : kMostSamplesPerPixel;
  }
  /// Samples that belong together.
  std::uint32_t unit() const { return films.film().groups().unit; }
  /// Pixels of all tiles of all ranks.
  std::uint64_t pixels() const {
    std::uint64_t count = 0;
    for (const PixelRect& tile : threads.scheduler().tiles()) count += tile.pixels();
    return count;
  }
};

}  // namespace lanelight
