// Chooses a strategy for a scene by a short trial run of candidates.
#pragma once

#include <atomic>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"
#include "src/render/job/job.h"
#include "src/render/plan/plan.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// AdvisedCandidate::meaning of the scene's own strategy.
inline constexpr const char* kOwnStrategy = "the scene's own strategy";

enum class CandidateStatus {
  kChosen,
  kKept,     // compared to the end, and not chosen
  kDropped,  // less efficient than others after the first round
  kSkipped,  // the trial ended before
  kRefused,  // the scene does not support it
};
/// "chosen", "kept", "dropped", "skipped", "refused".
const char* Name(CandidateStatus status);

/// A strategy to try on this scene, and its result.
struct AdvisedCandidate {
  Strategy strategy;                        // complete
  std::string changes;                      // relative to the default
  std::string meaning;                      // when it is more efficient
  double price = 1, price_uncertainty = 0;  // DecisionCandidate
  CandidateStatus status = CandidateStatus::kSkipped;
  std::string reason = {};  // of the status
  /// Efficiency relative to the default (1 without bounds for the default itself) with
  /// its 90 % interval, by samples that did not influence the choice.
  Interval efficiency = WithoutBounds(1);
  std::uint64_t samples = 0;  // of all rounds; 0: not compared
};

/// Returns the renderer's default (the scene's own strategy if the scene refuses that),
/// then kDecisionCandidates and the scene's own strategy, in the order of the trial.
std::vector<AdvisedCandidate> CandidatesFor(const PreparedScene& scene,
                                            const PlanOptions& options);

/// Combines two changes of different axes; none if they are of one axis, or one is the
/// scene's own strategy.
std::optional<AdvisedCandidate> Together(const AdvisedCandidate& a,
                                         const AdvisedCandidate& b);

/// Adds changes (text as in --strategy) to a candidate.
AdvisedCandidate WithAddedChanges(AdvisedCandidate candidate, const std::string& changes);

/// Rays that a second of the trial stands for, about the speed of two processors of 2020.
/// Counting work in rays makes the advice the same on every machine.
inline constexpr double kRaysPerSecond = 8e6;

struct AdviceOptions {
  double seconds = 0;  // wall clock of trial and render together
  double pilot =
      0;  // seconds of the trial at kRaysPerSecond; 0: kTrialFraction of `seconds`
  const std::atomic<bool>* stop = nullptr;
};

/// Fraction of the time for the trial; small, since the advice may change nothing.
inline constexpr double kTrialFraction = 0.03;

struct Advice {
  /// The renderer's default, then changes of one axis and the scene's own strategy, then
  /// a combination of the two best.
  std::vector<AdvisedCandidate> candidates;
  Strategy chosen;
  std::string why;            // one sentence
  double pilot_seconds = 0;   // wall clock
  std::uint64_t rays = 0;     // of the trial
  double seconds_to_try = 0;  // AdviceOptions::pilot that tries all candidates
  bool interrupted = false;   // by the user, or because the trial took too long
};

/// Describes the tried changes, other than the scene's own strategy.
inline constexpr const char* kTriedByAdvice =
    "roulette, light selection and path reuse; not samplers or other keys, "
    "which `lanelight study` compares";

/// Returns whether an interval is too wide to state: its ends differ by more than a
/// factor of kMaxUncertainty.
bool IsUncertain(const Interval& efficiency);
inline constexpr double kMaxUncertainty = 1000;

/// Runs the trial. Compares candidates by relative variance times counted work, on the
/// same pixels (StrategyTrial): first all; then the default, the best two and their
/// combination; last the best and the default on other pixels, which decide. The advice
/// depends only on scene, settings and seed, unless the trial exceeds three times its
/// planned time.
Advice Advise(const Job& job, const AdviceOptions& options);

/// Returns the job with the chosen strategy and the remaining time as its budget (at
/// least a hundredth of the whole time).
Job WithAdvice(Job job, const Advice& advice, const AdviceOptions& options);

/// Writes "candidates", "chosen", "why", "pilot_seconds", "pilot_rays", "interrupted".
nlohmann::json ToJson(const Advice& advice);

}  // namespace lanelight
