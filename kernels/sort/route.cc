// Bins what scatters into one queue per kind of material, so that each shading kernel
// runs on full vectors of its own kind; those that take light samples also go to kLit.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/materials.h"

LANELIGHT_BEGIN_KERNELS

template <bool kLights>
void Route(Wave& wave) {
  const DI di;
  const MaterialTable& m = *wave.materials;
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
    MF lit = hn::FirstN(DF(), 0), routed = lit;
    for (int k = 0; k < num_kinds; ++k) {
      const MF mine = hn::And(
          valid, hn::RebindMask(
                     DF(), hn::Eq(kind, hn::Set(di, static_cast<int32_t>(kinds[k])))));
      Push(wave.queue(ShadeQueue(kinds[k])), slots, mine);
      routed = hn::Or(routed, mine);
      // Light samples are of no use to delta directions.
      if (!HasTrait(kinds[k], kSpecularOnly)) lit = hn::Or(lit, mine);
    }
    LL_DCHECK(AllUnder(valid, routed));
    // At once, so that the queue keeps the order of the slots.
    if (kLights) Push(wave.queue(QueueId::kLit), slots, lit);
  });
}

Stage RouteStage() {
  return {.name = "route",
          .meaning = "bins what scatters by material kind",
          .input = QueueId::kVertex,
          .role = StageRole::kSort,
          .needs = {Feature::kScatters},
          .reads = {Field::material},
          .resolve = ByFeature<Feature::kLights, Route<true>, Route<false>>};
}

LANELIGHT_END_KERNELS
