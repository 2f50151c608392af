#include "src/cli/sweep_progress.h"

#include <fmt/format.h>

#include "src/cli/console.h"

namespace lanelight {
namespace {

std::string Describe(const SweepProgress& p) {
  return fmt::format("{} of {}  {}", p.done + 1, p.total, p.cell->name);
}

}  // namespace

void SweepProgressPrinter::Update(const SweepProgress& p) {
  if (style_ == ProgressStyle::kNone) return;
  const std::lock_guard lock(mutex_);
  if (style_ == ProgressStyle::kLines) {
    if (p.cell->name == last_cell_) return;
    last_cell_ = p.cell->name;
    return PrintError("sweep: " + Describe(p));
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - last_draw_ < kRedraw) return;
  last_draw_ = now;
  const double fraction = (double(p.done) + p.render.fraction) / double(p.total);
  RedrawLine(ProgressPrinter::Bar(fraction, kBarCells) + " " + Describe(p) +
             ProgressPrinter::Describe(p.render));
  drawn_ = true;
}

void SweepProgressPrinter::Say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (drawn_) RedrawLine("");
  drawn_ = false;
  PrintError(line);
}

void SweepProgressPrinter::Finish() {
  const std::lock_guard lock(mutex_);
  if (drawn_) RedrawLine("");
  drawn_ = false;
}

}  // namespace lanelight
