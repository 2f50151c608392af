#include "src/render/plan/plan.h"

#include <unistd.h>

#include <algorithm>
#include <utility>

#include "kernels/stages.h"
#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/render/plan/plan_features.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {
namespace {

using Stages = std::vector<Stage>;

Stages RegisteredStages(SimdTarget target) {
  return {
#define X(name) name##Stage(target),
      LANELIGHT_STAGES(X)
#undef X
  };
}

std::string ReasonToOmit(const Stage& stage, const FeatureSet& features) {
  for (int i = 0; i < int(Feature::kCount); ++i) {
    const Feature f = static_cast<Feature>(i);
    if (stage.needs.Has(f) && !features.Has(f)) return WithoutFeature(f);
  }
  return "";
}

void CheckReadsAreWritten(const std::vector<PlannedStage>& stages,
                          const FeatureSet& features) {
  FieldSet written;
  for (const PlannedStage& planned : stages) {
    for (std::size_t i = 0; i < kNumFields; ++i) {
      const Field field = static_cast<Field>(i);
      if (!IsLive(field, features)) continue;
      if (!planned.stage.reads.Has(field) || written.Has(field)) continue;
      // A stage may update what it also writes only if an earlier stage initialised it.
      FailCheck(__FILE__, __LINE__, "every column read has been written",
                std::string(planned.stage.name) + " reads " + FieldName(field));
    }
    written = written | planned.stage.writes;
  }
}

// The stages between the first and the last that resample light candidates
// (kernels/lights/candidates.cc) run once for each candidate, with the last.
void FindRepeated(Phase& phase) {
  const auto resamples = [](const PlannedStage& planned) {
    return planned.stage.role == StageRole::kResample;
  };
  const auto& stages = phase.stages;
  const auto first = std::ranges::find_if(stages, resamples);
  if (first == stages.end()) return;
  const auto last = std::find_if(stages.rbegin(), stages.rend(), resamples);
  phase.first_repeated = std::size_t(first - stages.begin()) + 1;
  phase.last_repeated = std::size_t(stages.rend() - last) - 1;
  LL_CHECK_LT(phase.first_repeated, phase.last_repeated);
}

// Finds the shadow kernels for path reuse, which tests visibility between vertices
// without lights.
void FindShadowKernels(const Stages& registered, Plan& plan) {
  if (!plan.features.Has(Feature::kReuse)) return;
  RayKernels& found = plan.ray_kernels;
  FeatureSet shadows = plan.features;
  shadows.Add({Feature::kLights, Feature::kOpaqueShadows});
  for (const Stage& stage : registered) {
    if (stage.role != StageRole::kShadow || !shadows.HasAll(stage.needs)) continue;
    LL_CHECK_LT(found.num_shadow, RayKernels::kMaxKernels);
    found.shadow[found.num_shadow++] = stage.resolve(shadows);
  }
}

PhaseId PhaseOf(StageScope scope) {
  switch (scope) {
    case StageScope::kTile:
      return PhaseId::kTile;
    case StageScope::kBlock:
      return PhaseId::kBlock;
    default:
      return PhaseId::kPaths;
  }
}

// Adds a phase of those stages of the registry that its features need, unless there are
// none; that of paths always.
void AddPhase(PhaseId id, const FeatureSet& features, const Stages& registered,
              Plan& plan) {
  Phase phase;
  phase.id = id;
  phase.in_waves = id != PhaseId::kTile && id != PhaseId::kBlock;
  const bool from_lights = features.Has(Feature::kLightSubpath);
  phase.features = features;
  const PhaseId stages = phase.in_waves ? PhaseId::kPaths : id;
  for (const Stage& stage : registered) {
    if (PhaseOf(stage.scope) != stages || !features.HasAll(stage.needs)) continue;
    // Light subpaths sample no lights, and bring nothing to samples.
    if (from_lights &&
        (stage.role == StageRole::kAccumulate || stage.role == StageRole::kLight)) {
      continue;
    }
    phase.stages.push_back({stage, stage.resolve(features)});
  }
  if (phase.stages.empty() && id != PhaseId::kPaths) return;
  phase.first_row = plan.phases.empty() ? 0 : plan.rows();
  if (phase.in_waves) CheckReadsAreWritten(phase.stages, features);
  FindRepeated(phase);
  plan.phases.push_back(std::move(phase));
}

void AddPhases(const PreparedScene& scene, const Stages& registered, Plan& plan) {
  for (const PhaseId id : {PhaseId::kPaths, PhaseId::kTile, PhaseId::kBlock}) {
    AddPhase(id, plan.features, registered, plan);
  }
  if (plan.features.Has(Feature::kLightPaths)) {
    AddPhase(PhaseId::kLightPaths, LightPathFeatures(plan.features), registered, plan);
  }
  if (!RendersLightsSeparately(scene)) return;
  FeatureSet features = VisibleLightFeatures(scene, plan.options);
  AddPhase(PhaseId::kVisibleLights, features, registered, plan);
  // A path with other wavelengths sees no other lights.
  if (!features.Has(Feature::kSpectral)) return;
  features.Remove(Feature::kSpectral);
  AddPhase(PhaseId::kFindEdges, features, registered, plan);
}

// Shadow rays through interfaces use the kernels of the path's rays. They need only the
// point and both normals of a surface.
RayKernels FindRayKernels(const Plan& plan) {
  RayKernels found;
  if (!plan.features.Has(Feature::kInterfaces)) return found;
  FeatureSet bare = plan.features;
  bare.Remove({Feature::kTangents, Feature::kUv, Feature::kBumps, Feature::kNormalMaps,
               Feature::kTextureFootprints});
  for (const PlannedStage& planned : plan.paths().stages) {
    if (planned.stage.role == StageRole::kIntersect) {
      LL_CHECK_LT(found.num_closest, RayKernels::kMaxKernels);
      found.closest[found.num_closest++] = planned.kernel;
    } else if (planned.stage.role == StageRole::kSurface) {
      LL_CHECK_LT(found.num_surface, RayKernels::kMaxKernels);
      found.surface[found.num_surface++] = planned.stage.resolve(bare);
    }
  }
  return found;
}

// Paths whose live columns fill half of one core's second-level cache, leaving
// the rest to the scene: the stages stream the columns once per bounce.
std::uint32_t WavefrontForCache(std::size_t bytes_per_path) {
  const long level2 = sysconf(_SC_LEVEL2_CACHE_SIZE);
  const double cache = level2 > 0 ? double(level2) : 1024.0 * 1024.0;
  const double paths = 0.5 * cache / double(bytes_per_path);
  return std::uint32_t(std::clamp(paths, 256.0, 8192.0)) / 64 * 64;
}

}  // namespace

const Phase* Plan::Find(PhaseId id) const {
  const auto found =
      std::ranges::find_if(phases, [id](const Phase& phase) { return phase.id == id; });
  return found == phases.end() ? nullptr : &*found;
}

Plan MakePlan(const PreparedScene& scene, const PlanOptions& options) {
  if (options.auxiliary != Auxiliary::kNone && options.max_depth == 0) {
    throw InputError(
        "auxiliary output (--aov, --gbuffer) describes surfaces where paths scatter: it "
        "needs a "
        "maximum depth of at least 1");
  }
  Plan plan;
  plan.options = options;
  plan.features = PlanFeatures(scene, options);
  plan.notes = CheckStrategy(scene, options);
  const Stages registered = RegisteredStages(options.target);
  AddPhases(scene, registered, plan);
  for (const Stage& stage : registered) {
    if (plan.features.HasAll(stage.needs)) continue;
    plan.omitted.push_back({stage, ReasonToOmit(stage, plan.features)});
  }
  for (std::size_t i = 0; i < kNumFields; ++i) {
    const Field field = static_cast<Field>(i);
    const bool live = IsLive(field, plan.features);
    (live ? plan.live_fields : plan.absent_fields).push_back(field);
  }
  plan.ray_kernels = FindRayKernels(plan);
  FindShadowKernels(registered, plan);
  plan.bytes_per_path = plan.live_fields.size() * sizeof(float);
  // New samples start only while the live paths fit (kernels/generate/generate.cc). Slots
  // are taken from the top of a stack, so most of the room for copies is rarely used: the
  // cache must hold twice the paths.
  const std::size_t copies = plan.features.Has(Feature::kSplitting) ? 2 : 1;
  plan.wavefront = options.wavefront > 0
                       ? options.wavefront
                       : WavefrontForCache(plan.bytes_per_path * copies);
  // A pair starts together.
  if (plan.features.Has(Feature::kAntitheticPairs)) {
    plan.wavefront = std::max(plan.wavefront, 2u);
  }
  plan.slots =
      plan.wavefront * (plan.features.Has(Feature::kSplitting) ? kMaxSplitPaths : 1);
  return plan;
}

}  // namespace lanelight
