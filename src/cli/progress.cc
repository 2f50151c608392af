#include "src/cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "src/cli/console.h"

namespace lanelight {
namespace {

int TerminalColumns() {
  winsize size = {};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

void WriteError(const std::string& text) {
  const char* at = text.data();
  std::size_t left = text.size();
  while (left > 0) {
    const ssize_t n = write(STDERR_FILENO, at, left);
    if (n <= 0) return;  // nobody reads it: the render goes on
    at += n;
    left -= static_cast<std::size_t>(n);
  }
}

}  // namespace

void RedrawLine(const std::string& text) {
  const auto room = static_cast<std::size_t>(std::max(TerminalColumns() - 1, 20));
  WriteError("\r\x1b[K" + text.substr(0, std::min(text.size(), room)));
}

ProgressStyle ChooseProgressStyle(bool quiet) {
  if (quiet) return ProgressStyle::kNone;
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal != nullptr && std::string(terminal) == "dumb";
  return isatty(STDERR_FILENO) && !dumb ? ProgressStyle::kBar : ProgressStyle::kLines;
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

std::string DurationText(double seconds) {
  if (!(seconds >= 0) || seconds > 1e9) return "unknown";
  if (seconds > 0 && seconds < 0.00995) return fmt::format("{:.2g} ms", 1e3 * seconds);
  if (seconds < 1) return fmt::format("{:.0f} ms", 1e3 * seconds);
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string ProgressPrinter::Describe(const Progress& p) {
  const double fraction = std::clamp(p.fraction, 0.0, 1.0);
  std::string text = fmt::format("{:3.0f} %", std::floor(100 * fraction));
  if (p.seconds <= 0) return text;
  text += fmt::format("  {}samples/s", CountText(double(p.samples) / p.seconds));
  if (fraction >= 1) return text + fmt::format("  {}", DurationText(p.seconds));
  if (fraction > 0) {
    text += fmt::format("  {} left", DurationText(p.seconds * (1 - fraction) / fraction));
  }
  return text;
}

std::string ProgressPrinter::Bar(double fraction, int width) {
  const int full = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
  return "[" + std::string(full, '#') + std::string(width - full, '.') + "]";
}

void ProgressPrinter::Draw(const Progress& progress) {
  const std::string text = Describe(progress);
  if (style_ == ProgressStyle::kLines) {
    WriteError("rendering " + text + "\n");
    return;
  }
  const int room = TerminalColumns() - static_cast<int>(text.size()) - 4;
  const std::string bar =
      room >= 8 ? Bar(progress.fraction, std::min(room, 40)) + " " : "";
  WriteError("\r\x1b[K" + bar + text);  // erases the line before drawing it
  drawn_ = true;
}

void ProgressPrinter::Update(const Progress& progress) {
  if (style_ == ProgressStyle::kNone) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  const int tenth = static_cast<int>(progress.fraction * 10);
  const bool due = style_ == ProgressStyle::kLines
                       ? tenth > last_tenth_
                       : progress.fraction >= 1 || now - last_draw_ >= kRedraw;
  if (!due) return;
  last_tenth_ = std::max(tenth, last_tenth_);
  last_draw_ = now;
  Draw(progress);
}

void ProgressPrinter::Finish() {
  const std::lock_guard lock(mutex_);
  if (drawn_) WriteError("\n");
  drawn_ = false;
}

}  // namespace lanelight
