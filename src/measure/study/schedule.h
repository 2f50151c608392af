// How many samples per pixel a study's renders take.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include "src/measure/study/runs.h"

namespace lanelight {

/// What timed renders say of a strategy's speed.
struct Calibration {
  double samples = 1;  // per pixel in the budget, at least 1
  /// Standard error of log(samples), by the scatter of the timed renders.
  double spread = 0;
  /// Samples per pixel for a relative error of kSmallError, by the timed renders' own
  /// estimates; infinite where they state none.
  double for_small_error = std::numeric_limits<double>::infinity();
};

struct TimedRender {
  double samples = 0, seconds = 0;
};

/// How many samples a budget is enough for, by the line through two timed renders: what a
/// render takes before its first sample, to learn or to set up, is the same for all
/// sizes. What a sample takes is the longer timed's mean at most, and a quarter of it at
/// least: noise may turn the line around.
double SamplesOfBudget(double budget, const TimedRender& timed, const TimedRender& few);

/// Calibrates strategies to `seconds` of wall clock each. After renders that warm up
/// caches and tables and find a size, timed renders of about half the budget (between
/// kMinTimedSeconds and kMaxTimedSeconds), and of a quarter of their samples, run
/// kTimedRounds times, in turns (A B C A B C ...), so that a change of the machine's
/// speed meets all alike; medians count, and a line through both sizes. Strategies are
/// compared by processor time, which does not count other programs; how much wall clock
/// that is, is common to all. Empty if `stop` was set.
std::vector<Calibration> Calibrate(const Job& job,
                                   const std::vector<Strategy>& strategies,
                                   double seconds, const std::atomic<bool>* stop);
inline constexpr int kTimedRounds = 5;
inline constexpr double kMinTimedSeconds = 0.02, kMaxTimedSeconds = 1;

/// The largest sample count of a study that is asked for neither counts nor a budget:
/// what kDefaultStudySeconds are enough for, but at least kLeastLargest, or as many as
/// bring the baseline's error to kSmallError. Strategies rank otherwise after a few
/// samples than after many. A power of two.
std::uint64_t DefaultLargest(const Calibration& baseline);

/// Powers of two below `largest`, and `largest` rounded down to seven binary digits.
std::vector<std::uint64_t> CountsUpTo(std::uint64_t largest);

/// Sets the sample counts of the strategies that are ok, and how sure they are: those
/// asked for; with a budget, up to what each renders in that time; else powers of two up
/// to what the first one renders in kDefaultStudySeconds. Ascending, without duplicates.
/// If `stop` was set, there are none.
void ChooseCounts(const StudyOptions& options, const Job& job,
                  std::vector<StrategyRuns>& strategies, const std::atomic<bool>* stop);

}  // namespace lanelight
