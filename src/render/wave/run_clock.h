// The time that a run has taken, in this process and before it.
#pragma once

#include "src/base/core/stopwatch.h"

namespace lanelight {

class RunClock {
 public:
  void Start() { watch_ = {}; }
  /// The run goes on, after so many seconds of which others have counted the processor's.
  void GoOn(double seconds) { before_ = seconds; }

  /// Seconds since Start().
  double Seconds() const { return watch_.Seconds(); }
  /// Processor seconds of all threads of this process since Start().
  double CpuSeconds() const { return watch_.CpuSeconds(); }
  /// Seconds of the whole run.
  double Elapsed() const { return before_ + Seconds(); }

 private:
  Stopwatch watch_;
  double before_ = 0;
};

}  // namespace lanelight
