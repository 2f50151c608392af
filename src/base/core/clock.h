// Clocks for measuring the program itself: a cheap one for a stage call, and the
// processor time of the whole process.
#pragma once

#include <chrono>
#include <cstdint>

#include "src/base/core/machine.h"

namespace lanelight {

/// Time since some fixed moment, in a unit that TickScale measures. About 10 ns a call
/// with time stamps (machine.h); without, it reads std::chrono::steady_clock.
inline std::uint64_t Ticks() {
  if (kHasTimeStamps) return TimeStamp();
  return static_cast<std::uint64_t>(
      std::chrono::steady_clock::now().time_since_epoch().count());
}

/// Converts ticks to seconds. Measures their length against steady_clock while it lives:
/// the longer, the more exact (about 1e-4 after 1 ms).
class TickScale {
 public:
  TickScale();
  std::uint64_t start() const { return ticks_; }
  /// Seconds per tick. Waits until 100 us have passed since the construction.
  double SecondsPerTick() const;

 private:
  std::chrono::steady_clock::time_point time_;
  std::uint64_t ticks_;
};

/// Processor time of all threads of this process, in seconds; 0 where unknown.
double ProcessCpuSeconds();

/// The same of the calling thread. About 0.3 us.
double ThreadCpuSeconds();

}  // namespace lanelight
