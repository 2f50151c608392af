#include "src/render/run/run_schedule.h"

#include <algorithm>

#include "src/base/core/parallel.h"

namespace lanelight {

void RunSchedule::Start(bool resumed) {
  const double budget = context_.options.seconds;
  ThreadWork& threads = context_.threads;
  if (budget > 0) {
    pace_.emplace(budget, Pace::Tasks{threads.scheduler().Snapshot().size(), MaxThreads(),
                                      threads.samples_per_range(), context_.unit()});
  }
  if (resumed) CheckIfDue(LastLevel());
}

std::optional<Round> RunSchedule::Next() {
  const std::uint64_t done = context_.work.Done(), limit = context_.limit();
  if (done >= limit || reached_ || hopeless_) return std::nullopt;
  Round round =
      pace_ ? pace_->Next(done, context_.clock.Elapsed())
            : RoundAfter(done, context_.threads.samples_per_range(), context_.unit());
  // The seed of kernels changes between rounds.
  const std::uint64_t next_seed = (done / kSamplesPerSeed + 1) * kSamplesPerSeed;
  round.end = std::min({limit, NextCheck(done), round.end, next_seed});
  round_watch_ = {};
  return round;
}

void RunSchedule::Finish(const Round& round) {
  if (pace_) pace_->AddMeasurement(round.samples(), round_watch_.Seconds());
  const bool halfway = 2 * context_.clock.Elapsed() > context_.options.seconds;
  if (pace_ && reserved_ == 0 && halfway) TimeFit();
  CheckIfDue(round.end);
}

// A control variate is fitted once more after the last round.
void RunSchedule::TimeFit() {
  const Stopwatch watch;
  context_.films.film().FitControl();
  reserved_ = watch.Seconds();
}

std::uint64_t RunSchedule::NextCheck(std::uint64_t done) const {
  if (!context_.options.samples_needed) return kMaxSamplesPerPixel;
  return CheckFrom(done + 1, context_.unit());
}

int RunSchedule::Checks() const {
  if (!context_.options.samples_needed) return 0;
  return ChecksUpTo(context_.work.Done(), context_.unit());
}

// If pixels have fractions of the samples, a run may have been at its last check already,
// and no pixel has had more samples since.
std::uint64_t RunSchedule::LastLevel() const {
  const std::uint64_t done = context_.work.Done();
  std::uint64_t at = done;
  for (auto next = NextCheck(0); next <= done; next = NextCheck(next)) at = next;
  return context_.work.IsAt(at) ? at : done;
}

// A run that was paused within a round has made its check before; a film with different
// numbers of samples would give another answer than an uninterrupted run gets.
void RunSchedule::CheckIfDue(std::uint64_t done) {
  if (!context_.options.samples_needed || done == 0 || !context_.work.IsAt(done)) return;
  if (done != CheckFrom(done, context_.unit()) && done != context_.limit()) return;
  context_.work.Gather();
  context_.films.film().FitControl();
  needed_ = context_.options.samples_needed(context_.films.film(), done);
  hopeless_ = needed_ < 0;
  reached_ = !hopeless_ && needed_ <= double(done);
}

}  // namespace lanelight
