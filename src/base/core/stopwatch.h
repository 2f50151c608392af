// Measures time.
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
  /// Returns the wall time since the start, in seconds.
  double Seconds() const { return SecondsSince(start_); }
  /// Of the processor, by all threads of this process.
  double CpuSeconds() const { return ProcessCpuSeconds() - start_cpu_; }
  /// Returns the wall time in seconds and restarts.
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
