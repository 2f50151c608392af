// The strategies that `lanelight advise` tries on a scene.
#pragma once

#include <string>
#include <vector>

#include "src/compiled/scene.h"
#include "src/wavefront/decision_candidates.h"
#include "src/wavefront/plan.h"

namespace lanelight {

/// What a candidate means that is the scene's own strategy.
inline constexpr const char* kOwnStrategy = "the scene's own strategy";

/// A strategy to try on this scene.
struct Candidate {
  Strategy strategy;
  std::string changes, meaning;        // no changes: the default
  double price = 1, price_spread = 0;  // DecisionCandidate
  std::string refused;                 // why the scene does not take it; empty if it does
};

/// The renderer's default first, then kDecisionCandidates, and the scene's own strategy
/// within them if that is another, in the order in which a short trial tries them.
/// `options`: of the plans that are tried. `scene` ends with its own strategy. (If the
/// scene refused the default, its own would be first.)
std::vector<Candidate> CandidatesFor(CompiledScene& scene, const PlanOptions& options);

/// The axis of a change: "roulette" of "roulette=none".
std::string AxisOf(const std::string& changes);

/// `strategy` with the changes (text as in --strategy).
Strategy Changed(const Strategy& strategy, const std::string& changes);

}  // namespace lanelight
