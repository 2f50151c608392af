// Bins what scatters into one queue per kind of material, so that each shading kernel
// runs on full vectors of its own kind; those that take light samples also go to kLit.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/sort/route.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kLights>
void Route(Wave& wave) {
  const DI di;
  const MaterialTable& m = wave.scene->materials;
  const Queue& vertices = wave.queue(QueueId::kVertex);
  // Which kinds the scene has is decided per call, never per lane.
  ShadeKind kinds[kNumShadeKinds];
  int num_kinds = 0;
  for (int k = 0; k < kNumShadeKinds; ++k) {
    if (wave.run->features.Has(ShadeFeature(static_cast<ShadeKind>(k)))) {
      kinds[num_kinds++] = static_cast<ShadeKind>(k);
    }
  }
  ForEachBatch(wave, vertices, [&](const Slots& slots, MF valid) HWY_ATTR {
    const VI kind = Lookup(m.kind, Gather(wave.path.material, slots));
    MF lit = hn::FirstN(DF(), 0);
    for (int k = 0; k < num_kinds; ++k) {
      const MF mine = hn::And(
          valid, hn::RebindMask(
                     DF(), hn::Eq(kind, hn::Set(di, static_cast<int32_t>(kinds[k])))));
      Push(wave.queue(ShadeQueue(kinds[k])), slots, mine);
      // Light samples are of no use to delta directions.
      if (!HasTrait(kinds[k], kSpecularOnly)) lit = hn::Or(lit, mine);
    }
    // At once, so that the queue keeps the order of the slots.
    if (kLights) Push(wave.queue(QueueId::kLit), slots, lit);
  });
}

void RouteLit(Wave& wave) { Route<true>(wave); }
void RouteUnlit(Wave& wave) { Route<false>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/path/stage.h"

namespace lanelight {

HWY_EXPORT(RouteLit);
HWY_EXPORT(RouteUnlit);

Stage RouteStage() {
  return {.name = "route",
          .meaning = "bins what scatters by material kind",
          .input = QueueId::kVertex,
          .needs = {Feature::kScatters},
          .reads = {Field::material},
          .resolve = [](const FeatureSet& features) -> StageFn {
            return features.Has(Feature::kLights) ? HWY_DYNAMIC_DISPATCH(RouteLit)
                                                  : HWY_DYNAMIC_DISPATCH(RouteUnlit);
          }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
