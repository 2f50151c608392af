// How far a study is: one line redrawn on a terminal, plain lines otherwise.
#pragma once

#include <chrono>
#include <string>

#include "src/cli/progress.h"
#include "src/study/runs.h"

namespace lanelight {

class StudyProgressPrinter {
 public:
  explicit StudyProgressPrinter(ProgressStyle style) : style_(style) {}
  void Update(const StudyProgress& progress);
  /// A line of its own, above the bar.
  void Say(const std::string& line);
  void Finish();

  /// " 37 %  cornell-box: mis, 64 spp, repetition 3  2 min 03 s left"
  static std::string Describe(const StudyProgress& progress);

 private:
  ProgressStyle style_;
  std::chrono::steady_clock::time_point last_draw_{};
  int last_twentieth_ = -1;
  std::string last_scene_;
  bool drawn_ = false;
};

}  // namespace lanelight
