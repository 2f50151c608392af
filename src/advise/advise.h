// Which strategy to render a scene with, by a short pilot over the candidates.
#pragma once

#include <atomic>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/render/job.h"
#include "src/advise/halving.h"

namespace lanelight {

struct AdviceOptions {
  double seconds = 0;   // wall clock that pilot and render have together
  double share = 0.05;  // of it, for the pilot
  const std::atomic<bool>* stop = nullptr;
};

struct AdvisedCandidate {
  std::string strategy, changes,
      meaning;  // complete; against the scene's own; when it pays
  CandidateOutcome outcome;
  std::string relative_to;  // changes that its efficiency relates to; empty: the default
};

struct Advice {
  /// The renderer's default first, then changes of one axis of it, among them the scene's
  /// own strategy, then combinations of changes that were better alone.
  std::vector<AdvisedCandidate> candidates;
  Strategy chosen;
  std::string why;           // one sentence
  double pilot_seconds = 0;  // wall clock
  /// Efficiency of the chosen strategy on the whole image, relative to what the windows
  /// chose; 0 unless that made it the chosen one.
  double rare_gain = 0;
  bool interrupted = false;
};

/// Runs the pilot. Candidates are compared by the estimated relative variance of small
/// windows of the image times processor time (Halve). `job` then has the chosen strategy,
/// a plan for it, and the rest of the time as its budget (at least a hundredth of it).
/// Where the pilot is too short to tell, it is the default.
Advice Advise(Job& job, const AdviceOptions& options);

/// "candidates", "chosen", "why", "pilot_seconds", "interrupted".
nlohmann::json ToJson(const Advice& advice);

}  // namespace lanelight
