// Which of several strategies is the most efficient on a scene, found with little effort:
// sequential halving (Karnin, Koren and Somekh 2013; Jamieson and Talwalkar 2016). Rounds
// measure all candidates that are left on the same random windows of the image; the
// certainly worse half goes; the next round costs as much, for fewer.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/stat/efficiency.h"

namespace lanelight {

/// What one candidate did on the windows of a round. Windows are rendered in batches, the
/// candidates taking turns, so that how far the speed of the machine scatters is measured
/// as well.
struct WindowErrors {
  std::vector<double> all;         // mean squared relative error of each window
  std::vector<double> robust;      // the same without the worst pixels of the round
  std::vector<double> seconds;     // of processor time: each window's share of its batch
  std::vector<std::size_t> batch;  // of each window, counted from 0, ascending
};

/// Measures these candidates (indices) on `windows` fresh windows, the same for all.
/// Returns as many results, or none at all if it was interrupted. `elapsed` is set to
/// what this took of the budget.
using MeasureRound = std::function<std::vector<WindowErrors>(
    const std::vector<std::size_t>& candidates, std::size_t windows, double& elapsed)>;

struct HalvingOptions {
  double seconds = 0;  // budget for all rounds
  /// Fewer windows say nothing of a candidate: rather leave candidates out.
  std::size_t least_windows = 8;
  std::size_t most_windows = 256;  // in a round
  /// That a candidate is worse than the best, for all claims of a round together.
  double drop_confidence = 0.95;
  /// That the chosen one is better than candidate 0, two-sided. Lower: a wrong change
  /// costs no more than a missed one.
  double choose_confidence = 0.8;
};

enum class CandidateStatus {
  kChosen,
  kKept,     // to the end, but not certainly better than candidate 0, or not the best
  kWorse,    // certainly worse than the best candidate of its round
  kHalved,   // among the less efficient half of its round
  kSkipped,  // the budget did not reach it
  kRefused,  // the scene does not take it
};
const char* Name(CandidateStatus status);

struct CandidateOutcome {
  CandidateStatus status = CandidateStatus::kSkipped;
  std::string reason;
  int rounds = 0;
  std::size_t windows = 0;
  /// Efficiency relative to candidate 0: robust (with interval; that of candidate 0
  /// itself is 1, without), and with all pixels.
  Interval efficiency = WithoutBounds(1);
  double with_all_pixels = 1;
  /// The smaller one: rare bright pixels may be missing from either's sample.
  double Score() const;
};

struct HalvingResult {
  std::size_t chosen = 0;
  std::vector<CandidateOutcome> candidates;
  double seconds = 0;  // elapsed
  bool interrupted = false;
};

/// Candidate 0 is the default: always measured, chosen unless another is certainly better
/// (robustly), better with all pixels too, and better by its `margins` entry (0.15: by
/// 15 %). Candidates come in the order in which the budget is given to them.
HalvingResult Halve(const std::vector<double>& margins, const MeasureRound& measure,
                    const HalvingOptions& options);

}  // namespace lanelight
