// Which strategy to render a scene with, by a trial of the candidates.
#pragma once

#include <atomic>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/measure/advise/candidates.h"
#include "src/render/job/job.h"

namespace lanelight {

/// Work is counted in rays, so that advice is the same on every machine: a second of the
/// trial stands for so many, about what two processors of 2020 trace.
inline constexpr double kRaysPerSecond = 8e6;

struct AdviceOptions {
  double seconds = 0;  // wall clock that trial and render have together
  double pilot = 0;    // of the trial, at kRaysPerSecond; 0: kPilotShare of `seconds`
  const std::atomic<bool>* stop = nullptr;
};

/// Of the time. Advice that changes nothing must not cost much.
inline constexpr double kPilotShare = 0.03;

struct Advice {
  /// The renderer's default first, then changes of one axis of it, among them the scene's
  /// own strategy, then a combination of the two best.
  std::vector<AdvisedCandidate> candidates;
  Strategy chosen;
  std::string why;            // one sentence
  double pilot_seconds = 0;   // wall clock
  std::uint64_t rays = 0;     // of the trial
  double seconds_to_try = 0;  // AdviceOptions::pilot by which none would be skipped
  bool interrupted = false;   // by the user, or since the trial took far too long
};

/// What changes it tries, beside the scene's own strategy.
inline constexpr const char* kTriedByAdvice =
    "roulette, light selection and path reuse; not samplers or other keys, "
    "which `lanelight study` compares";

/// An efficiency of which a trial has seen too little to state an interval: its ends are
/// more than kMostUncertain apart.
bool IsUncertain(const Interval& efficiency);
inline constexpr double kMostUncertain = 1000;

/// Runs the trial. Candidates are compared by relative variance times counted work, on
/// the same pixels (StrategyTrial): first all; then the default, the best two and what
/// both make together; last the best and the default on yet other pixels, which decide.
/// What is advised is a function of scene, settings and seed, unless the trial has to be
/// ended since it takes three times what it should.
Advice Advise(const Job& job, const AdviceOptions& options);

/// The job with the chosen strategy, and with the rest of the time as its budget (at
/// least a hundredth of it).
Job WithAdvice(Job job, const Advice& advice, const AdviceOptions& options);

/// "candidates", "chosen", "why", "pilot_seconds", "pilot_rays", "interrupted".
nlohmann::json ToJson(const Advice& advice);

}  // namespace lanelight
