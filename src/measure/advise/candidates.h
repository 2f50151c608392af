// The strategies that `lanelight advise` tries on a scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"
#include "src/render/plan/plan.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// What a candidate means that is the scene's own strategy.
inline constexpr const char* kOwnStrategy = "the scene's own strategy";

enum class CandidateStatus {
  kChosen,
  kKept,     // compared to the end, and not chosen
  kDropped,  // less efficient than others when all had been tried once
  kSkipped,  // the trial's time did not reach it
  kRefused,  // the scene does not take it
};
/// "chosen", "kept", "dropped", "skipped", "refused".
const char* Name(CandidateStatus status);

/// A strategy to try on this scene, and what becomes of it.
struct AdvisedCandidate {
  Strategy strategy;                   // complete
  std::string changes;                 // against the default, which has none
  std::string meaning;                 // when it pays
  double price = 1, price_spread = 0;  // DecisionCandidate
  CandidateStatus status = CandidateStatus::kSkipped;
  std::string reason = {};  // of the status
  /// How many times as efficient as the default (1, without bounds, for that itself),
  /// with its 90 % interval; by samples that have chosen nothing.
  Interval efficiency = WithoutBounds(1);
  std::uint64_t samples = 0;  // of all rounds; 0: not compared
};

/// The renderer's default first, then kDecisionCandidates, and the scene's own strategy
/// within them if that is another, in the order in which a short trial tries them.
/// `options`: of the plans that are tried. (If the scene refused the default, its own
/// would be first.)
std::vector<AdvisedCandidate> CandidatesFor(const PreparedScene& scene,
                                            const PlanOptions& options);

/// What two changes of different axes make together; none if they are of one axis, or one
/// of them is the scene's own strategy.
std::optional<AdvisedCandidate> Together(const AdvisedCandidate& a,
                                         const AdvisedCandidate& b);

/// A candidate with further changes (text as in --strategy).
AdvisedCandidate WithMore(AdvisedCandidate candidate, const std::string& changes);

}  // namespace lanelight
