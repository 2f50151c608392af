// Wall clock and processor time of all threads, for builds.
#pragma once

#include <ctime>

#include "bench/intersect/build.h"

namespace lanelight::bench {

class BuildClock {
 public:
  BuildRun Stop() const {
    return {Now(CLOCK_MONOTONIC) - wall_, Now(CLOCK_PROCESS_CPUTIME_ID) - cpu_};
  }

 private:
  static double Now(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double wall_ = Now(CLOCK_MONOTONIC), cpu_ = Now(CLOCK_PROCESS_CPUTIME_ID);
};

}  // namespace lanelight::bench
