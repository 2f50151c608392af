#include "src/measure/advise/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/render/plan/plan_features.h"
#include "src/render/train/strategy_trial.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

// A light BVH selects hardly better than by power if there are fewer lights.
constexpr std::size_t kFewLights = 4;

// The scene's own strategy is tried after the changes with the largest gains, which are
// all that a short trial reaches.
constexpr std::ptrdiff_t kPlaceOfOwn = 3;

// Spread of the cost of a ray for strategies without measured cost.
constexpr double kUnknownPriceUncertainty = 0.15;

// Returns why the scene refuses the strategy; empty if not, with `key` its plan's key.
std::string ReasonToOmit(const Strategy& strategy, const PlanOptions& options,
                         const PreparedScene& scene, std::string& key) {
  if (strategy.light_selection == LightSelection::kTree &&
      scene.Parts().lights->lights.size() < kFewLights) {
    const std::size_t lights = scene.Parts().lights->lights.size();
    return fmt::format("with {} light{} there is little to select", lights,
                       lights == 1 ? "" : "s");
  }
  try {
    const PreparedScene prepared = WithStrategy(scene, strategy);
    key = PlanKey(prepared, MakePlan(prepared, options));
  } catch (const InputError& error) {
    const std::string text = error.what(), prefix = "strategy: ";
    const std::size_t at = text.find(prefix);
    return at == std::string::npos ? text : text.substr(at + prefix.size());
  }
  return "";
}

// Returns the axis of a change: "roulette" of "roulette=none".
std::string AxisOf(const std::string& changes) {
  return changes.substr(0, changes.find('='));
}

}  // namespace

const char* Name(CandidateStatus status) {
  constexpr const char* kNames[] = {"chosen", "kept", "dropped", "skipped", "refused"};
  return kNames[int(status)];
}

AdvisedCandidate WithAddedChanges(AdvisedCandidate candidate,
                                  const std::string& changes) {
  ApplyStrategy(changes, {std::make_shared<const std::string>("advise"), 0, 0},
                candidate.strategy);
  candidate.changes = JoinedChanges(candidate.changes, changes);
  return candidate;
}

std::optional<AdvisedCandidate> Together(const AdvisedCandidate& a,
                                         const AdvisedCandidate& b) {
  if (a.meaning == kOwnStrategy || b.meaning == kOwnStrategy ||
      AxisOf(a.changes) == AxisOf(b.changes)) {
    return std::nullopt;
  }
  AdvisedCandidate both;
  both.strategy = a.strategy;
  both.changes = a.changes;
  both.meaning = "both changes are more efficient";
  both.price = a.price * b.price;
  both.price_uncertainty = std::hypot(a.price_uncertainty, b.price_uncertainty);
  return WithAddedChanges(both, b.changes);
}

std::vector<AdvisedCandidate> CandidatesFor(const PreparedScene& scene,
                                            const PlanOptions& options) {
  const Strategy own = scene.strategy, baseline;
  std::vector<AdvisedCandidate> out = {{baseline, "", "the renderer's default"}};
  for (const DecisionCandidate& c : kDecisionCandidates) {
    AdvisedCandidate changed = WithAddedChanges({}, c.changes);
    if (changed.strategy == own) continue;
    changed.meaning = c.reason;
    changed.price = c.price;
    changed.price_uncertainty = c.price_uncertainty;
    out.push_back(changed);
  }
  if (own != baseline) {
    out.insert(out.begin() + kPlaceOfOwn,
               {own, ToText(own), kOwnStrategy, 1, kUnknownPriceUncertainty});
  }
  std::vector<std::string> keys;
  for (AdvisedCandidate& candidate : out) {
    std::string key;
    candidate.reason = ReasonToOmit(candidate.strategy, options, scene, key);
    // Equal plans give equal bits; only timing would differ.
    const auto twin = std::ranges::find(keys, key);
    if (candidate.reason.empty() && twin != keys.end()) {
      const std::string& changes = out[std::size_t(twin - keys.begin())].changes;
      candidate.reason =
          "is on this scene identical to " + (changes.empty() ? "the default" : changes);
    }
    if (!candidate.reason.empty()) candidate.status = CandidateStatus::kRefused;
    keys.push_back(candidate.reason.empty() ? key : "-");
  }
  // The comparison needs a first candidate that is not refused.
  if (out.front().status == CandidateStatus::kRefused) {
    std::swap(out[0], out[kPlaceOfOwn]);
  }
  return out;
}

}  // namespace lanelight
