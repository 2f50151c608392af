// How far a run of stress cases is: one line redrawn on a terminal, a line per case
// otherwise.
#pragma once

#include <string>

#include "src/cli/progress.h"
#include "src/stress/suite.h"

namespace lanelight {

class StressProgressPrinter {
 public:
  explicit StressProgressPrinter(ProgressStyle style) : style_(style) {}
  void Update(const stress::SuiteProgress& progress);
  void Finish();

 private:
  ProgressStyle style_;
  std::string last_case_;
};

}  // namespace lanelight
