// The time that a run has taken, in this process and before it.
#pragma once

#include <chrono>

#include "src/core/clock.h"

namespace lanelight {

/// Seconds between `start` and now.
inline double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class RunClock {
 public:
  void Start() {
    start_ = std::chrono::steady_clock::now();
    start_cpu_ = ProcessCpuSeconds();
  }
  /// The run goes on, after so many seconds of which others have counted the processor's.
  void GoOn(double seconds) { before_ = seconds; }

  /// Seconds since Start().
  double Seconds() const { return SecondsSince(start_); }
  /// Processor seconds of all threads of this process since Start().
  double CpuSeconds() const { return ProcessCpuSeconds() - start_cpu_; }
  /// Seconds of the whole run.
  double Elapsed() const { return before_ + Seconds(); }

 private:
  std::chrono::steady_clock::time_point start_;
  double start_cpu_ = 0, before_ = 0;
};

}  // namespace lanelight
