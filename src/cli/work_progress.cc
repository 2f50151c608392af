#include "src/cli/work_progress.h"

#include "src/cli/console.h"

namespace lanelight {

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

void WorkProgress::Say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  Erase();
  PrintError(line);
}

void WorkProgress::Finish() {
  const std::lock_guard lock(mutex_);
  Erase();
}

}  // namespace lanelight
