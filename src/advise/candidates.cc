#include "src/advise/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "src/prepare/use_strategy.h"
#include "src/wavefront/plan_key.h"

namespace lanelight {
namespace {

// Samplers of directions differ most in rare bright samples: a light seen by one material
// sample in a million, or a glossy lobe hit by one light sample in a thousand. Combining
// both is never much worse than either (Veach and Guibas 1995), one alone can be.
constexpr double kSeldomChanges = 0.15;

// A tree over fewer lights finds no more than their power says.
constexpr std::size_t kFewLights = 4;

// The control variate integrates over every light at every hit: beyond this many it costs
// more than the rest of the path, and its trial most of the pilot's time.
constexpr std::size_t kManyLights = 16;

// After the changes that gain most where they gain: a short pilot reaches these only.
constexpr std::ptrdiff_t kPlaceOfOwn = 3;

constexpr CandidateInfo kCandidates[] = {
    {"roulette=none", "pays where paths are short or end late on bright lights", 0},
    {"roulette=adjoint", "pays where little of the scene carries the light", 0.03},
    {"directions=bsdf", "no shadow rays; pays under large, even lights", kSeldomChanges},
    {"light-selection=tree", "pays with many lights, each near a part of the scene", 0},
    {"roulette=luminance", "shorter paths; pays where deep paths matter little", 0},
    {"points=pmj02", "as sobol, and cheaper on some machines", 0},
    {"directions=light", "no weights; pays for small lights and rough surfaces",
     kSeldomChanges},
    {"control=ambient", "pays in the open, under an environment", 0},
    {"control=analytic", "pays where little is shadowed", 0},
};

// Why the scene does not take the strategy; empty if it does. `key` is then its plan's.
std::string Refusal(const Strategy& strategy, const PlanOptions& options,
                    CompiledScene& scene, std::string& key) {
  if (strategy.light_selection == LightSelection::kTree &&
      scene.lights.lights.size() < kFewLights) {
    const std::size_t lights = scene.lights.lights.size();
    return fmt::format("with {} light{} there is little to select", lights,
                       lights == 1 ? "" : "s");
  }
  if (strategy.control == Control::kAnalytic &&
      scene.lights.lights.size() > kManyLights) {
    return fmt::format("with {} lights it costs more than it saves",
                       scene.lights.lights.size());
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

std::span<const CandidateInfo> AdviseCandidates() { return kCandidates; }

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
  std::vector<Candidate> out = {{usual, "", "the renderer's default", 0, ""}};
  for (const CandidateInfo& info : kCandidates) {
    const Strategy changed = Changed(usual, info.changes);
    if (changed == own) continue;
    out.push_back({changed, info.changes, info.reason, info.margin, ""});
  }
  if (own != usual) {
    out.insert(out.begin() + kPlaceOfOwn, {own, ToText(own), kOwnStrategy, 0, ""});
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
