// Measures elapsed time.
#pragma once

#include <chrono>

#include "src/base/core/clock.h"

namespace lanelight {

/// Seconds between `start` and now.
inline double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs from its construction on.
class Stopwatch {
 public:
  /// Seconds of the wall clock.
  double Seconds() const { return SecondsSince(start_); }
  /// Processor time of all threads of this process, in seconds.
  double CpuSeconds() const { return ProcessCpuSeconds() - start_cpu_; }
  /// Returns Seconds() and restarts.
  double Lap() {
    const double seconds = Seconds();
    *this = {};
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double start_cpu_ = ProcessCpuSeconds();
};

}  // namespace lanelight
