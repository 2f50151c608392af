// How many samples per pixel a study's renders take.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "src/study/runs.h"

namespace lanelight {

/// What pilots say of a strategy's speed.
struct Calibration {
  double samples = 1;  // per pixel in the budget, at least 1
  /// Standard error of log(samples), by the scatter of the pilots.
  double spread = 0;
};

/// Calibrates strategies to `seconds` of wall clock each. After renders that warm up
/// caches and tables and find a size, pilots of about half the budget (between
/// kShortestPilot and kLongestPilot) run kPilotRounds times, in turns (A B C A B C ...),
/// so that a change of the machine's speed meets all alike; medians count. Strategies are
/// compared by processor time, which does not count other programs; how much wall clock
/// that is, is common to all. Empty if `stop` was set.
std::vector<Calibration> Calibrate(Job& job, const std::vector<Strategy>& strategies,
                                   double seconds, const std::atomic<bool>* stop);
inline constexpr int kPilotRounds = 5;
inline constexpr double kShortestPilot = 0.02, kLongestPilot = 1;

/// Powers of two below `largest`, and `largest` rounded to five binary digits.
std::vector<std::uint64_t> CountsUpTo(std::uint64_t largest);

/// Sets the sample counts of the strategies that are ok, and how sure they are: those
/// asked for; with a budget, up to what each renders in that time; else powers of two up
/// to what the first one renders in kDefaultStudySeconds. Ascending, without duplicates.
/// If `stop` was set, there are none.
void ChooseCounts(const StudyOptions& options, Job& job,
                  std::vector<StrategyRuns>& strategies, const std::atomic<bool>* stop);

}  // namespace lanelight
