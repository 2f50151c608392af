#include "src/cli/study_progress.h"

#include <fmt/format.h>

#include <cmath>

#include "src/cli/console.h"

namespace lanelight {

std::string StudyProgressPrinter::Describe(const StudyProgress& p) {
  std::string text =
      fmt::format("{:3.0f} %  {}: {}", std::floor(100 * p.fraction), p.scene, p.what);
  if (p.fraction > 0.01) text += fmt::format("  {} left", DurationText(p.seconds_left));
  return text;
}

void StudyProgressPrinter::Update(const StudyProgress& p) {
  if (style_ == ProgressStyle::kNone) return;
  if (style_ == ProgressStyle::kLines) {
    const int twentieth = static_cast<int>(20 * p.fraction);
    if (twentieth <= last_twentieth_ && p.scene == last_scene_) return;
    last_twentieth_ = twentieth;
    last_scene_ = p.scene;
    return PrintError("study " + Describe(p));
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - last_draw_ < kRedraw) return;
  last_draw_ = now;
  RedrawLine(ProgressPrinter::Bar(p.fraction, kBarCells) + " " + Describe(p));
  drawn_ = true;
}

void StudyProgressPrinter::Say(const std::string& line) {
  if (drawn_) RedrawLine("");
  PrintError(line);
}

void StudyProgressPrinter::Finish() {
  if (drawn_) RedrawLine("");
  drawn_ = false;
}

}  // namespace lanelight
