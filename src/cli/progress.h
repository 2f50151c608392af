// How far a render is: one line redrawn on a terminal, a plain line every tenth
// otherwise.
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

/// Three digits and the prefix of a unit: "512 ", "12.3 k", "1.24 G".
std::string CountText(double value);
/// The same of a count that stands alone.
std::string TotalText(double value);

/// More columns than a description has.
inline constexpr std::size_t kDescribeAll = 1000;

class ProgressPrinter {
 public:
  explicit ProgressPrinter(ProgressStyle style) : style_(style) {}
  /// Erases what is drawn and not finished: an error has ended the work.
  ~ProgressPrinter() {
    Interrupt([] {});
  }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  bool Shows() const { return style_ != ProgressStyle::kNone; }
  /// Prints if it is time to; may be called from any thread.
  void Update(const RenderProgress& progress);
  /// Says what is done before rendering, in the place of the bar; a plain line if there
  /// is no terminal and `always`.
  void Say(const std::string& text, bool always);
  /// Calls print(), which writes lines, where the bar was.
  void Interrupt(const std::function<void()>& print);
  /// Ends the line of the bar.
  void Finish();

  /// The text of a line without its bar, " 42 %  3.2 s left  error 1.71 % [1.69, 1.73]
  /// 5.1 Msamples/s": as much of it as fits `room` columns, whatever counts most first.
  static std::string Describe(const RenderProgress& progress, std::size_t room);
  /// The bar in front of it, `width` cells wide.
  static std::string Bar(double fraction, int width);

 private:
  void Draw(const RenderProgress& progress);

  ProgressStyle style_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_draw_{};
  int last_tenth_ = 0;
  bool drawn_ = false;
};

}  // namespace lanelight
