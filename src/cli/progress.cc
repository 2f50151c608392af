#include "src/cli/progress.h"

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "src/cli/console.h"
#include "src/cli/texts.h"

namespace lanelight {
namespace {

void WriteError(const std::string& text) {
  const char* at = text.data();
  std::size_t left = text.size();
  while (left > 0) {
    const ssize_t n = write(STDERR_FILENO, at, left);
    if (n <= 0) return;  // no reader: the render continues
    at += n;
    left -= std::size_t(n);
  }
}

}  // namespace

void RedrawLine(const std::string& text) {
  const std::size_t room = TerminalColumns(Stream::kError) - 1;
  WriteError("\r\x1b[K" + text.substr(0, std::min(text.size(), room)));
}

ProgressStyle ChooseProgressStyle(bool quiet) {
  if (quiet) return ProgressStyle::kNone;
  return IsTerminal(Stream::kError) ? ProgressStyle::kBar : ProgressStyle::kLines;
}

std::string CountText(double value) {
  static constexpr const char* kUnits[] = {"", "k", "M", "G", "T"};
  if (value < 9999.5) return fmt::format("{:.0f} ", value);
  int unit = 0;
  while (value >= 999.5 && unit < 4) {
    value /= 1000;
    ++unit;
  }
  const int decimals = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}", value, decimals, kUnits[unit]);
}

std::string TotalText(double value) {
  std::string text = CountText(value);
  if (text.back() == ' ') text.pop_back();
  return text;
}

std::string ProgressPrinter::Describe(const RenderProgress& p, std::size_t room) {
  const double fraction = std::clamp(p.fraction, 0.0, 1.0);
  std::string text = fmt::format("{:3.0f} %", std::floor(100 * fraction));
  if (p.seconds <= 0) return text;
  std::vector<std::string> parts;
  if (fraction >= 1) {
    parts.push_back(DurationText(p.seconds));
  } else if (p.target_seconds) {
    parts.push_back("target in " + DurationText(*p.target_seconds));
  } else if (fraction > 0) {
    parts.push_back(DurationText(p.seconds * (1 - fraction) / fraction) + " left");
  }
  if (p.error) parts.push_back("error " + BriefPercentText(*p.error));
  parts.push_back(CountText(double(p.samples) / p.seconds) + "samples/s");
  for (const std::string& part : parts) {
    if (text.size() + 2 + part.size() > room) break;
    text += "  " + part;
  }
  return text;
}

std::string ProgressPrinter::Bar(double fraction, int width) {
  const int full = int(std::clamp(fraction, 0.0, 1.0) * width);
  return "[" + std::string(full, '#') + std::string(width - full, '.') + "]";
}

void ProgressPrinter::Draw(const RenderProgress& progress) {
  if (style_ == ProgressStyle::kLines) {
    WriteError("rendering " + Describe(progress, kDescribeAll) + "\n");
    return;
  }
  const std::size_t columns = TerminalColumns(Stream::kError) - 1;
  const std::string text = Describe(progress, columns);
  const int room = int(columns) - int(text.size()) - 3;
  const std::string bar =
      room >= 8 ? Bar(progress.fraction, std::min(room, 40)) + " " : "";
  WriteError("\r\x1b[K" + bar + text);  // erases the line before drawing it
  drawn_ = true;
}

void ProgressPrinter::Update(const RenderProgress& progress) {
  if (style_ == ProgressStyle::kNone) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  const int tenth = int(progress.fraction * 10);
  const bool due = style_ == ProgressStyle::kLines
                       ? tenth > last_tenth_
                       : progress.fraction >= 1 || now - last_draw_ >= kRedraw;
  if (!due) return;
  last_tenth_ = std::max(tenth, last_tenth_);
  last_draw_ = now;
  Draw(progress);
}

void ProgressPrinter::PrintMessage(const std::string& text, bool always) {
  const std::lock_guard lock(mutex_);
  if (style_ == ProgressStyle::kLines && always) WriteError(text + "\n");
  if (style_ != ProgressStyle::kBar) return;
  RedrawLine(text);
  drawn_ = true;
}

void ProgressPrinter::Interrupt(const std::function<void()>& print) {
  const std::lock_guard lock(mutex_);
  if (drawn_) WriteError("\r\x1b[K");
  drawn_ = false;
  print();
}

void ProgressPrinter::Finish() {
  const std::lock_guard lock(mutex_);
  if (drawn_) WriteError("\n");
  drawn_ = false;
}

void WorkProgress::Update(const WorkStep& step) {
  if (style_ == ProgressStyle::kNone) return;
  const std::lock_guard lock(mutex_);
  if (style_ == ProgressStyle::kLines) {
    if (step.part <= last_part_ && step.name == last_name_) return;
    last_part_ = step.part;
    last_name_ = step.name;
    return PrintError(work_ + step.text);
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - last_draw_ < kRedraw) return;
  last_draw_ = now;
  RedrawLine(ProgressPrinter::Bar(step.fraction, kBarCells) + " " + step.text +
             step.detail);
  drawn_ = true;
}

void WorkProgress::Erase() {
  if (drawn_) RedrawLine("");
  drawn_ = false;
}

void WorkProgress::PrintMessage(const std::string& line) {
  const std::lock_guard lock(mutex_);
  Erase();
  PrintError(line);
}

void WorkProgress::Finish() {
  const std::lock_guard lock(mutex_);
  Erase();
}

}  // namespace lanelight
