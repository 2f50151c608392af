
#include <fmt/format.h>

#include "src/base/core/hash.h"
#include "src/render/plan/plan_features.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

std::uint64_t HashLights(const LightChances& chances) {
  StreamHash hash;
  hash.AddArray(chances.pmf);
  hash.AddArray(chances.alias_q);
  hash.AddArray(chances.alias);
  hash.AddArray(chances.tree.nodes);
  hash.AddArray(chances.tree.far);
  if (!chances.emission.empty()) hash.AddArray(chances.emission.pmf);
  return hash.Digest();
}

std::string FeaturesText(const FeatureSet& features) {
  std::string text;
  for (int i = 0; i < int(Feature::kCount); ++i) {
    text += features.Has(static_cast<Feature>(i)) ? '1' : '0';
  }
  return text;
}

// Returns the parameters of the plan's strategy; omits what no stage reads.
std::string ParametersText(const Strategy& s, const FeatureSet& features) {
  const SamplerParameters sampler = MakeSamplerParameters(s.sampler);
  const MisParameters mis = MakeMisParameters(s);
  const SampleGroups groups = GroupsOf(s);
  std::string text =
      fmt::format("points {} groups {} {} mis {} {} {}", sampler.group_shift, groups.unit,
                  groups.replicates, mis.square, mis.linear, mis.hits);
  if (features.Has(Feature::kReuse)) {
    text += fmt::format(" reuse {} {}", s.reused_paths, Name(s.block_layout));
  }
  if (features.Has(Feature::kLightPaths)) {
    text += fmt::format(" light paths {}", s.light_path_samples);
  }
  if (features.HasAny({Feature::kRoulette, Feature::kSplitting})) {
    const RouletteParameters r = MakeRouletteParameters(s);
    text += fmt::format(" roulette {} {} {} {} {}", Name(s.roulette), r.termination,
                        r.floor, r.first, r.scale);
  }
  if (features.Has(Feature::kRegressionControl)) {
    text += fmt::format(" control {} {}", Name(s.control),
                        s.coefficient ? fmt::format("{}", *s.coefficient) : "optimal");
  }
  return text;
}

}  // namespace

std::string PlanKey(const PreparedScene& scene, const Plan& plan) {
  std::string key = FeaturesText(plan.features);
  for (const PlannedStage& planned : plan.paths().stages) {
    key += fmt::format(" {} {}", planned.stage.name,
                       reinterpret_cast<std::uintptr_t>(planned.kernel));
  }
  key += fmt::format(" depth {} ", plan.options.max_depth);
  key += ParametersText(PlannedStrategy(scene, plan.options), plan.features);
  if (plan.features.HasAll({Feature::kInfiniteImage, Feature::kLights}) &&
      CompensatesEnvironment(scene.strategy)) {
    key += " environment compensated";
  }
  if (RendersLightsSeparately(scene)) key += " seen lights apart";
  return key + fmt::format(" lights {:016x}", HashLights(*scene.chances));
}

}  // namespace lanelight
