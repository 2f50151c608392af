// How far the work of a laboratory is (a sweep, a study, a run of stress cases): one line
// redrawn on a terminal, plain lines otherwise.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "src/cli/progress.h"

namespace lanelight {

/// What is being done.
struct WorkStep {
  double fraction = 0;  // of all
  std::string name;     // a plain line is printed when it changes, or when `part` grows
  int part = 0;
  std::string text;         // of a plain line, and behind the bar
  std::string detail = "";  // behind that
};

class WorkProgress {
 public:
  /// `work`: before the text of a plain line.
  WorkProgress(ProgressStyle style, const char* work) : style_(style), work_(work) {}
  /// This and what follows may be called from any thread.
  void Update(const WorkStep& step);
  /// A line of its own, above the bar.
  void Say(const std::string& line);
  void Finish();

 private:
  void Erase();

  const ProgressStyle style_;
  const std::string work_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_draw_{};
  std::string last_name_;
  int last_part_ = -1;
  bool drawn_ = false;
};

}  // namespace lanelight
