#include "src/advise/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "src/prepare/use_strategy.h"
#include "src/wavefront/plan_key.h"

namespace lanelight {
namespace {

// A tree over fewer lights finds no more than their power says.
constexpr std::size_t kFewLights = 4;

// After the changes that gain most where they gain: a short pilot reaches these only.
constexpr std::ptrdiff_t kPlaceOfOwn = 3;

// Of what a ray costs, of strategies that nobody has timed.
constexpr double kUnknownSpread = 0.15;

// Why the scene does not take the strategy; empty if it does. `key` is then its plan's.
std::string Refusal(const Strategy& strategy, const PlanOptions& options,
                    CompiledScene& scene, std::string& key) {
  if (strategy.light_selection == LightSelection::kTree &&
      scene.lights.lights.size() < kFewLights) {
    const std::size_t lights = scene.lights.lights.size();
    return fmt::format("with {} light{} there is little to select", lights,
                       lights == 1 ? "" : "s");
  }
  try {
    UseStrategy(strategy, scene);
    key = PlanKey(scene, MakePlan(scene, options));
  } catch (const InputError& error) {
    const std::string text = error.what(), prefix = "strategy: ";
    const std::size_t at = text.find(prefix);
    return at == std::string::npos ? text : text.substr(at + prefix.size());
  }
  return "";
}

}  // namespace

std::string AxisOf(const std::string& changes) {
  return changes.substr(0, changes.find('='));
}

Strategy Changed(const Strategy& strategy, const std::string& changes) {
  Strategy changed = strategy;
  ApplyStrategy(changes, {std::make_shared<const std::string>("advise"), 0, 0}, changed);
  return changed;
}

std::vector<Candidate> CandidatesFor(CompiledScene& scene, const PlanOptions& options) {
  const Strategy own = scene.strategy, usual;
  std::vector<Candidate> out = {{usual, "", "the renderer's default", 1, 0, ""}};
  for (const DecisionCandidate& c : kDecisionCandidates) {
    const Strategy changed = Changed(usual, c.changes);
    if (changed == own) continue;
    out.push_back({changed, c.changes, c.reason, c.price, c.price_spread, ""});
  }
  if (own != usual) {
    out.insert(out.begin() + kPlaceOfOwn,
               {own, ToText(own), kOwnStrategy, 1, kUnknownSpread, ""});
  }
  std::vector<std::string> keys;
  for (Candidate& candidate : out) {
    std::string key;
    candidate.refused = Refusal(candidate.strategy, options, scene, key);
    // Equal plans give equal bits: what would differ is their timing alone.
    const auto twin = std::find(keys.begin(), keys.end(), key);
    if (candidate.refused.empty() && twin != keys.end()) {
      const std::string& changes = out[std::size_t(twin - keys.begin())].changes;
      candidate.refused = "does on this scene exactly what " +
                          (changes.empty() ? "the default" : changes) + " does";
    }
    keys.push_back(candidate.refused.empty() ? key : "-");
  }
  // A comparison needs its first.
  if (!out.front().refused.empty()) std::swap(out[0], out[kPlaceOfOwn]);
  UseStrategy(own, scene);
  return out;
}

}  // namespace lanelight
