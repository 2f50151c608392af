// The strategies that `lanelight advise` tries, in one place, each with its reason.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "src/compiled/scene.h"
#include "src/wavefront/plan.h"

namespace lanelight {

/// One change of the renderer's default strategy.
struct CandidateInfo {
  const char* changes;  // as in --strategy
  const char* reason;   // when it pays
  /// It must be this much more efficient to be chosen. More than nothing where bright
  /// samples that a pilot is likely to miss decide.
  double margin;
};

/// What a candidate means that is the scene's own strategy.
inline constexpr const char* kOwnStrategy = "the scene's own strategy";

/// In the order in which a short pilot tries them. Left out, because nothing here is
/// ever won by them: uniform directions, stratification that Sobol' points include
/// (stratified, cmj), antithetic pairs (they undo the stratification), a constant
/// roulette.
std::span<const CandidateInfo> AdviseCandidates();

/// A strategy to try on this scene.
struct Candidate {
  Strategy strategy;
  std::string changes, meaning;  // no changes: the default
  double margin = 0;
  std::string refused;  // why the scene does not take it; empty if it does
};

/// The renderer's default first, then the list, and the scene's own strategy within it if
/// that is another. `options`: of the plans that are tried. `scene` ends with its own
/// strategy. (If the scene refused the default, its own would be first.)
std::vector<Candidate> CandidatesFor(CompiledScene& scene, const PlanOptions& options);

/// The axis of a change: "roulette" of "roulette=none".
std::string AxisOf(const std::string& changes);

/// `strategy` with the changes (text as in --strategy).
Strategy Changed(const Strategy& strategy, const std::string& changes);

}  // namespace lanelight
