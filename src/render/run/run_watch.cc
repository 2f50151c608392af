#include "src/render/run/run_watch.h"

#include <algorithm>

namespace lanelight {

void RunWatch::Start() {
  limit_.emplace(setting_.options.seconds, setting_.clock.Elapsed());
}

bool RunWatch::OutOfTime() const {
  const double budget = setting_.options.seconds;
  // The first round always ends: an image with unsampled pixels is no image.
  return budget > 0 && every_pixel_ && setting_.clock.Elapsed() >= budget - reserved_;
}

bool RunWatch::Ended() {
  every_pixel_ = setting_.tasks.Done() > 0;
  return Interrupted() || OutOfTime() || cancelled_;
}

bool RunWatch::Stopped() const {
  const RunKeeper* const keeper = setting_.options.keeper;
  return Interrupted() || OutOfTime() || cancelled_ || show_.Due() ||
         (keeper != nullptr && keeper->Due());
}

bool RunWatch::Cancelled() const {
  // Without a budget only a stop matters, and clocks need not be read.
  const bool stopped = Interrupted();
  if (!stopped && setting_.options.seconds <= 0) return false;
  if (limit_->IsOver(stopped, every_pixel_, setting_.clock.Elapsed())) {
    cancelled_ = true;
  }
  return cancelled_;
}

StopReason RunWatch::Reason() const {
  if (checks_.reached()) return StopReason::kTarget;
  if (checks_.hopeless()) return StopReason::kHopeless;
  // Only what has left samples out counts: a signal may come after the last one.
  if (setting_.tasks.Done() >= setting_.limit()) return StopReason::kSamples;
  return Interrupted() ? StopReason::kInterrupted : StopReason::kTime;
}

double RunWatch::Fraction(double seconds, std::uint64_t samples) const {
  const RunOptions& options = setting_.options;
  const double per_pixel = double(samples) / double(setting_.tasks.pixels());
  const double by_samples = options.spp > 0 ? per_pixel / double(options.spp) : 0;
  const double by_time = options.seconds > 0 ? seconds / options.seconds : 0;
  // Errors fall like 1 / samples, so samples are in proportion to the time it takes.
  const double by_need = per_pixel / checks_.needed();
  return std::min(1.0, std::max({by_samples, by_time, by_need}));
}

void RunWatch::TaskDone() {
  const RunOptions& options = setting_.options;
  if (options.seconds > 0) limit_->Ended(setting_.clock.Elapsed());
  if (!options.on_progress) return;
  std::unique_lock lock(progress_mutex_, std::try_to_lock);
  if (!lock || SecondsSince(last_report_) < 0.1) return;
  last_report_ = std::chrono::steady_clock::now();
  Report();
}

void RunWatch::Report() {
  if (!setting_.options.on_progress) return;
  Progress progress;
  progress.seconds = setting_.clock.Elapsed();
  progress.samples = setting_.tasks.taken();
  progress.fraction = Fraction(progress.seconds, progress.samples);
  setting_.options.on_progress(progress);
}

}  // namespace lanelight
