#include "src/render/run/run_parts.h"

#include <algorithm>

#include "src/base/core/parallel.h"

namespace lanelight {

void RunParts::Start() {
  const double budget = setting_.options.seconds;
  if (budget <= 0) return;
  const Tasks& tasks = setting_.tasks;
  pace_.emplace(budget, Pace::Tasks{tasks.Held().size(), MaxThreads(), tasks.per_task(),
                                    setting_.unit()});
}

std::optional<RunPart> RunParts::Next() {
  const std::uint64_t done = setting_.tasks.Done(), limit = setting_.limit();
  if (done >= limit || watch_.Ended() || checks_.reached() || checks_.hopeless())
    return std::nullopt;
  const Round round = pace_
                          ? pace_->Next(setting_.clock.Elapsed())
                          : RoundAfter(done, setting_.tasks.per_task(), setting_.unit());
  RunPart part;
  part.begin = done;
  part.first = done / kSamplesPerSeed * kSamplesPerSeed;
  part.end = std::min(
      {limit, checks_.After(done), done + round.samples, part.first + kSamplesPerSeed});
  part.per_task = round.per_task;
  part.start = std::chrono::steady_clock::now();
  return part;
}

void RunParts::Finish(const RunPart& part) {
  if (pace_) pace_->Took(part.end - part.begin, SecondsSince(part.start));
  const bool halfway = 2 * setting_.clock.Elapsed() > setting_.options.seconds;
  if (pace_ && watch_.reserved() == 0 && halfway) TimeFit();
  checks_.CheckIfDue(part.end);
}

// A control variate is fitted once more after the last part.
void RunParts::TimeFit() {
  const auto begin = std::chrono::steady_clock::now();
  setting_.films.film().FitControl();
  watch_.Reserve(SecondsSince(begin));
}

}  // namespace lanelight
