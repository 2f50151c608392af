#include "src/render/plan/plan.h"

#include <unistd.h>

#include <algorithm>

#include "kernels/stages.h"
#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/render/plan/check_strategy.h"
#include "src/render/plan/plan_features.h"
#include "src/scene/prepare/path_values.h"

namespace lanelight {

namespace {

std::vector<Stage> RegisteredStages(SimdTarget target) {
  return {
#define X(name) name##Stage(target),
      LANELIGHT_STAGES(X)
#undef X
  };
}

std::string ReasonToOmit(const Stage& stage, const FeatureSet& features) {
  for (int i = 0; i < static_cast<int>(Feature::kCount); ++i) {
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
      // A stage may update what it also writes only if somebody initialised it.
      FailCheck(__FILE__, __LINE__, "every column read has been written",
                std::string(planned.stage.name) + " reads " + FieldName(field));
    }
    written = written | planned.stage.writes;
  }
}

// What lies between the first and the last stage of light candidates (light_candidates,
// light_keep: kernels/lights/candidates.cc) is run for each of them.
void FindRepeated(Plan& plan) {
  if (!plan.features.Has(Feature::kLightCandidates)) return;
  const auto resamples = [](const PlannedStage& planned) {
    return planned.stage.needs.Has(Feature::kLightCandidates);
  };
  const auto& stages = plan.stages;
  const auto first = std::find_if(stages.begin(), stages.end(), resamples);
  const auto last = std::find_if(stages.rbegin(), stages.rend(), resamples);
  LL_CHECK(first != stages.end());
  plan.first_repeated = static_cast<std::size_t>(first - stages.begin()) + 1;
  plan.last_repeated = static_cast<std::size_t>(stages.rend() - last) - 1;
  LL_CHECK_LT(plan.first_repeated, plan.last_repeated);
}

// Whether two vertices see each other has nothing to do with lights.
void FindShadowKernels(Plan& plan) {
  if (!plan.features.Has(Feature::kReuse)) return;
  RayKernels& found = plan.ray_kernels;
  FeatureSet shadows = plan.features;
  shadows.Add({Feature::kLights, Feature::kOpaqueShadows});
  for (const Stage& stage : RegisteredStages(plan.options.target)) {
    if (!stage.needs.Has(Feature::kOpaqueShadows) || !shadows.HasAll(stage.needs)) {
      continue;
    }
    LL_CHECK_LT(found.num_shadow, RayKernels::kMost);
    found.shadow[found.num_shadow++] = stage.resolve(shadows);
  }
}

// Shadow rays through interfaces use the kernels of the path's rays. Of a surface they
// need the point and both normals, nothing else of its columns.
RayKernels FindRayKernels(const Plan& plan) {
  RayKernels found;
  if (!plan.features.Has(Feature::kInterfaces)) return found;
  FeatureSet bare = plan.features;
  bare.Remove({Feature::kTangents, Feature::kUv, Feature::kBumps, Feature::kNormalMaps,
               Feature::kTextureFootprints});
  for (const PlannedStage& planned : plan.stages) {
    const Stage& stage = planned.stage;
    const bool point = stage.writes.Has(Field::p_error);
    if (stage.input == QueueId::kActive && stage.writes.Has(Field::prim) && !point) {
      LL_CHECK_LT(found.num_closest, RayKernels::kMost);
      found.closest[found.num_closest++] = planned.kernel;
    } else if (stage.input == QueueId::kSurface && point) {
      LL_CHECK_LT(found.num_surface, RayKernels::kMost);
      found.surface[found.num_surface++] = stage.resolve(bare);
    }
  }
  return found;
}

// Paths whose live columns fill half of one core's second-level cache, leaving
// the rest to the scene: the stages stream the columns once per bounce.
std::uint32_t WavefrontForCache(std::size_t bytes_per_path) {
  const long level2 = sysconf(_SC_LEVEL2_CACHE_SIZE);
  const double cache = level2 > 0 ? static_cast<double>(level2) : 1024.0 * 1024.0;
  const double paths = 0.5 * cache / static_cast<double>(bytes_per_path);
  return static_cast<std::uint32_t>(std::clamp(paths, 256.0, 8192.0)) / 64 * 64;
}

}  // namespace

Plan MakePlan(const PreparedScene& scene, const PlanOptions& options) {
  if (options.auxiliary != Auxiliary::kNone && options.max_depth == 0) {
    throw InputError(
        "auxiliary output (--aov, --gbuffer) tells of surfaces where paths scatter: it "
        "needs a "
        "maximum depth of at least 1");
  }
  Plan plan;
  plan.options = options;
  plan.features = PlanFeatures(scene, options);
  plan.notes = CheckStrategy(scene, options);
  const bool seen = SeesLightsApart(scene);
  if (seen) plan.seen_features = SeenLightFeatures(scene, options);
  for (const Stage& stage : RegisteredStages(options.target)) {
    if (plan.features.HasAll(stage.needs)) {
      auto& stages = stage.scope == StageScope::kWave ? plan.stages : plan.block_stages;
      stages.push_back({stage, stage.resolve(plan.features)});
    } else {
      plan.omitted.push_back({stage, ReasonToOmit(stage, plan.features)});
    }
    if (seen && stage.scope == StageScope::kWave &&
        plan.seen_features.HasAll(stage.needs)) {
      plan.seen_stages.push_back({stage, stage.resolve(plan.seen_features)});
    }
  }
  for (std::size_t i = 0; i < kNumFields; ++i) {
    const Field field = static_cast<Field>(i);
    const bool live = IsLive(field, plan.features);
    (live ? plan.live_fields : plan.absent_fields).push_back(field);
  }
  CheckReadsAreWritten(plan.stages, plan.features);
  CheckReadsAreWritten(plan.seen_stages, plan.seen_features);
  FindRepeated(plan);
  plan.ray_kernels = FindRayKernels(plan);
  FindShadowKernels(plan);
  plan.bytes_per_path = plan.live_fields.size() * sizeof(float);
  // New samples start only while the live paths fit (kernels/generate/generate.cc), and
  // slots are taken from the top of a stack, so most of the room for copies is seldom
  // touched: the cache is to hold twice the paths.
  const std::size_t copies = plan.features.Has(Feature::kSplitting) ? 2 : 1;
  plan.wavefront = options.wavefront > 0
                       ? options.wavefront
                       : WavefrontForCache(plan.bytes_per_path * copies);
  // A pair starts together.
  if (plan.features.Has(Feature::kAntitheticPairs)) {
    plan.wavefront = std::max(plan.wavefront, 2u);
  }
  plan.slots =
      plan.wavefront * (plan.features.Has(Feature::kSplitting) ? kMostCopies : 1);
  return plan;
}

}  // namespace lanelight
