// Seconds of processor time of the calling thread: unlike the wall clock it does not
// count what other programs take.
#pragma once

#include <ctime>

namespace lanelight::bench {

class CpuTimer {
 public:
  double Seconds() const { return Now() - start_; }

 private:
  static double Now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = Now();
};

}  // namespace lanelight::bench
