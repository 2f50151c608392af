// How far a sweep is: one line redrawn on a terminal, a line per cell otherwise.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "src/cli/progress.h"
#include "src/sweep/runner.h"

namespace lanelight {

class SweepProgressPrinter {
 public:
  explicit SweepProgressPrinter(ProgressStyle style) : style_(style) {}
  /// May be called from any thread.
  void Update(const SweepProgress& progress);
  /// A line of its own, above the bar.
  void Say(const std::string& line);
  void Finish();

 private:
  ProgressStyle style_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_draw_{};
  std::string last_cell_;
  bool drawn_ = false;
};

}  // namespace lanelight
