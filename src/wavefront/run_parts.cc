#include "src/wavefront/run_parts.h"

#include <algorithm>

#include "src/scene/rendered_pixels.h"
#include "src/wavefront/allocation.h"
#include "src/wavefront/share.h"

namespace lanelight {

void RunParts::Start() {
  const double budget = setting_.options.seconds;
  if (budget > 0) pace_.emplace(budget, PaceTasks());
}

void RunParts::GoOn() {
  AllocateIfDue();
  looks_.LookAgain();
}

std::optional<RunPart> RunParts::Next() {
  const std::uint64_t done = setting_.tasks.Done(), limit = setting_.limit();
  if (done >= limit || watch_.Ended() || looks_.reached() || looks_.hopeless())
    return std::nullopt;
  const Round round = NextRound();
  RunPart part;
  part.begin = done;
  part.first = done / kSamplesPerSeed * kSamplesPerSeed;
  part.end = std::min({limit, looks_.After(done), NextDecision(done),
                       done + round.samples(), part.first + kSamplesPerSeed});
  part.per_task = round.per_task;
  part.start = std::chrono::steady_clock::now();
  return part;
}

void RunParts::Finish(const RunPart& part) {
  if (pace_) pace_->Took(part.end - part.begin, SecondsSince(part.start));
  const bool halfway = 2 * setting_.clock.Elapsed() > setting_.options.seconds;
  if (pace_ && watch_.reserved() == 0 && halfway) TimeFit();
  AllocateIfDue();
  looks_.LookIfDue(part.end);
}

// Where pixels begin to differ in their samples.
std::uint64_t RunParts::NextDecision(std::uint64_t done) const {
  return setting_.allocates() && done < kAllocationPilot ? kAllocationPilot
                                                         : kMostSamplesPerPixel;
}

// What the pilot says is in the films, for a run that goes on later.
void RunParts::AllocateIfDue() {
  Tasks& tasks = setting_.tasks;
  if (!setting_.allocates() || allocated_ || tasks.Done() < kAllocationPilot) return;
  allocated_ = true;
  Films& films = setting_.films;
  if (tasks.IsAt(kAllocationPilot)) {
    const PixelRect window = RenderedPixels(setting_.scene.film);
    const int side = CellSide(window);
    films.weights() = WeighPixels(films.film(), side);
  }
  tasks.UseShares(films);
  if (pace_) pace_->Cut(PaceTasks());
}

Pace::Tasks RunParts::PaceTasks() const {
  Pace::Tasks tasks;
  tasks.tiles = setting_.tasks.tiles();
  tasks.threads = setting_.crew.threads();
  tasks.most = setting_.tasks.FullRound();
  tasks.unit = setting_.unit();
  return tasks;
}

Round RunParts::NextRound() const {
  if (pace_) return pace_->Next(setting_.clock.Elapsed());
  return setting_.crew.Widen(setting_.tasks.FullRound());
}

// A control variate is fitted once more after the last part.
void RunParts::TimeFit() {
  const auto begin = std::chrono::steady_clock::now();
  setting_.films.film().FitControl();
  watch_.Reserve(SecondsSince(begin));
}

}  // namespace lanelight
