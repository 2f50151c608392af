// Progress of a render: one line redrawn on a terminal, else a plain line every tenth.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

#include "src/render/job/error_so_far.h"

namespace lanelight {

/// Time between two drawings of a line, about 10 a second, and cells of its bar.
inline constexpr auto kRedraw = std::chrono::milliseconds(95);
inline constexpr int kBarCells = 24;

enum class ProgressStyle { kNone, kLines, kBar };

/// kBar if standard error is a terminal, else kLines; kNone if `quiet`.
ProgressStyle ChooseProgressStyle(bool quiet);

/// Replaces the line of the terminal that the cursor is in, cut off at its width.
void RedrawLine(const std::string& text);

/// Returns three digits and the prefix of a unit: "512 ", "12.3 k", "1.24 G".
std::string CountText(double value);
/// Returns the count without a unit to follow.
std::string TotalText(double value);

/// More columns than a description has.
inline constexpr std::size_t kDescribeAll = 1000;

class ProgressPrinter {
 public:
  explicit ProgressPrinter(ProgressStyle style) : style_(style) {}
  /// Erases an unfinished bar, after an error.
  ~ProgressPrinter() {
    Interrupt([] {});
  }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  bool Shows() const { return style_ != ProgressStyle::kNone; }
  /// Prints if it is due; from any thread.
  void Update(const RenderProgress& progress);
  /// Shows a text in place of the bar, before rendering; without a terminal a plain line
  /// if `always`.
  void PrintMessage(const std::string& text, bool always);
  /// Calls print(), which writes lines in place of the bar.
  void Interrupt(const std::function<void()>& print);
  /// Ends the line of the bar.
  void Finish();

  /// Returns the text beside the bar, " 42 %  3.2 s left  error 1.71 % [1.69, 1.73]  5.1
  /// Msamples/s": its most important parts that fit `room` columns.
  static std::string Describe(const RenderProgress& progress, std::size_t room);
  /// Returns a bar of `width` cells.
  static std::string Bar(double fraction, int width);

 private:
  void Draw(const RenderProgress& progress);

  ProgressStyle style_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_draw_{};
  int last_tenth_ = 0;
  bool drawn_ = false;
};

/// A step of the work.
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
  void PrintMessage(const std::string& line);
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
