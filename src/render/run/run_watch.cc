#include "src/render/run/run_watch.h"

#include <algorithm>
#include <limits>

namespace lanelight {

void RunWatch::Start() {
  const double now = context_.clock.Elapsed();
  limit_.emplace(context_.options.seconds, now);
  pixels_ = context_.pixels();
  const bool shown = context_.options.on_film && context_.options.group == nullptr;
  show_at_ = shown ? now + kDisplaySecondsPerPixel * double(pixels_) / kMaxDisplayFraction
                   : std::numeric_limits<double>::infinity();
}

void RunWatch::ShowIfDue() {
  if (!ShowDue()) return;
  const double since = show_at_;
  context_.films.film().FitControl();
  context_.options.on_film(context_.films.film());
  const double now = context_.clock.Elapsed();
  show_at_ = now + (now - since) / kMaxDisplayFraction;
}

bool RunWatch::OutOfTime() const {
  const double budget = context_.options.seconds;
  // The first round always ends, so that every pixel has a sample.
  return budget > 0 && every_pixel_ &&
         context_.clock.Elapsed() >= budget - schedule_.reserved();
}

bool RunWatch::HasEnded() {
  every_pixel_ = context_.work.Done() > 0;
  return IsInterrupted() || OutOfTime() || cancelled_;
}

bool RunWatch::IsStopped() const {
  const Checkpointer* const checkpointer = context_.options.checkpointer;
  return IsInterrupted() || OutOfTime() || cancelled_ || ShowDue() ||
         (checkpointer != nullptr && checkpointer->IsDue());
}

bool RunWatch::IsCancelled() const {
  // Without a budget only a stop matters, and clocks need not be read.
  const bool stopped = IsInterrupted();
  if (!stopped && context_.options.seconds <= 0) return false;
  if (limit_->IsOver(stopped, every_pixel_, context_.clock.Elapsed())) {
    cancelled_ = true;
  }
  return cancelled_;
}

StopReason RunWatch::Reason() const {
  if (schedule_.reached()) return StopReason::kTarget;
  if (schedule_.hopeless()) return StopReason::kHopeless;
  // A signal after the last sample does not count.
  if (context_.work.Done() >= context_.limit()) return StopReason::kSamples;
  return IsInterrupted() ? StopReason::kInterrupted : StopReason::kTime;
}

double RunWatch::Fraction(double seconds, std::uint64_t samples) const {
  const RunOptions& options = context_.options;
  const double per_pixel = double(samples) / double(pixels_);
  const double by_samples = options.spp > 0 ? per_pixel / double(options.spp) : 0;
  const double by_time = options.seconds > 0 ? seconds / options.seconds : 0;
  // Errors fall like 1 / samples, so samples are in proportion to the time it takes.
  const double by_need = per_pixel / schedule_.needed();
  return std::min(1.0, std::max({by_samples, by_time, by_need}));
}

void RunWatch::TaskDone() {
  const RunOptions& options = context_.options;
  if (options.seconds > 0) limit_->NoteTaskEnd(context_.clock.Elapsed());
  if (!options.on_progress) return;
  std::unique_lock lock(progress_mutex_, std::try_to_lock);
  if (!lock || SecondsSince(last_report_) < 0.1) return;
  last_report_ = std::chrono::steady_clock::now();
  Report();
}

void RunWatch::Report() {
  if (!context_.options.on_progress) return;
  Progress progress;
  progress.seconds = context_.clock.Elapsed();
  progress.samples = context_.work.RenderedSamples();
  progress.fraction = Fraction(progress.seconds, progress.samples);
  context_.options.on_progress(progress);
}

}  // namespace lanelight
