// The stages that sort paths into queues: hits and misses, paths that may scatter, kinds
// of materials.
#include "kernels/simd/each_target-inl.h"

#include <algorithm>

#include "kernels/queue/batch-inl.h"
#include "kernels/queue/depth-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/materials.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

// Returns whether the hit is ahead of the ray and a primitive of the scene.
HWY_INLINE MF IsHit(const Wave& wave, const Slots& slots) {
  const VI prim = Gather(wave.path.prim, slots);
  const VI end = hn::Set(DI(), static_cast<int32_t>(wave.ranges->end));
  const auto known = hn::AndNot(hn::Lt(prim, hn::Zero(DI())), hn::Lt(prim, end));
  return hn::And(hn::Ge(Gather(wave.path.t, slots), hn::Zero(DF())),
                 hn::RebindMask(DF(), known));
}

template <bool kEnvironment>
void Split(Wave& wave) {
  const Queue& active = wave.queue(QueueId::kActive);
  wave.rays_closest += active.size;
  ForEachBatch(wave, active, [&](const Slots& slots, MF valid) HWY_ATTR {
    const MF hit =
        hn::Lt(Gather(wave.path.t, slots), Splat(std::numeric_limits<float>::infinity()));
    LL_DCHECK(AllUnder(hit, IsHit(wave, slots)));
    Push(wave.queue(QueueId::kHit), slots, hn::And(valid, hit));
    const MF miss = hn::AndNot(hit, valid);
    if constexpr (kEnvironment) Push(wave.queue(QueueId::kMiss), slots, miss);
    // A path ends here whether or not the escape stage still adds to it.
    Push(wave.queue(QueueId::kDone), slots, miss);
  });
}

Stage HitsStage() {
  return {.name = "hits",
          .meaning = "sorts paths into hits and misses",
          .input = QueueId::kActive,
          .role = StageRole::kSort,
          .reads = {Field::t},
          .resolve = ByFeature<Feature::kInfiniteLights, Split<true>, Split<false>>};
}

// Ends paths that have used up their scattering events; the others continue to the
// surface stages. As in pbrt, a path of maximum depth D sees emission after D events.
//
// Paths that go through interfaces of media all continue: stage `interfaces` ends those
// that meet another surface.
template <bool kInterfaces>
void LimitDepth(Wave& wave) {
  if constexpr (kInterfaces) {
    const Queue& hits = wave.queue(QueueId::kHit);
    Queue& surfaces = wave.queue(QueueId::kSurface);
    std::copy_n(hits.items, hits.size, surfaces.items);
    surfaces.size = hits.size;
    return;
  }
  ForEachBatch(wave, wave.queue(QueueId::kHit),
               [&](const Slots& slots, MF valid) HWY_ATTR {
                 const MF below = MayScatter(wave, slots);
                 Push(wave.queue(QueueId::kSurface), slots, hn::And(valid, below));
                 Push(wave.queue(QueueId::kDone), slots, hn::AndNot(below, valid));
               });
}

Stage LimitStage() {
  return {
      .name = "max_depth",
      .meaning = "ends paths at the maximum depth",
      .input = QueueId::kHit,
      .role = StageRole::kSort,
      .reads = {Field::depth, Field::medium, Field::walked},
      .resolve = ByFeature<Feature::kInterfaces, LimitDepth<true>, LimitDepth<false>>};
}

// Appends surface hits to the queue of all scattering events. If only surfaces scatter,
// kVertex is the surface queue itself (src/vocabulary/path/wave.h).
void Vertices(Wave& wave) {
  ForEachBatch(wave, wave.queue(QueueId::kSurface),
               [&](const Slots& slots, MF valid)
                   HWY_ATTR { Push(wave.queue(QueueId::kVertex), slots, valid); });
}

Stage VerticesStage() {
  return {.name = "vertices",
          .meaning = "collects all paths that scatter",
          .input = QueueId::kSurface,
          .role = StageRole::kSort,
          .needs = {Feature::kOtherEvents, Feature::kScatters},
          .resolve = Always<Vertices>};
}

// Bins what scatters into one queue per kind of material, so that each shading kernel
// runs on full vectors of its own kind; those that take light samples also go to kLit.
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
    // All kinds are appended at once, so that the queue keeps the order of the slots.
    if (kLights) Push(wave.queue(QueueId::kLit), slots, lit);
  });
}

Stage RouteStage() {
  return {.name = "route",
          .meaning = "sorts scattering paths by material kind",
          .input = QueueId::kVertex,
          .role = StageRole::kSort,
          .needs = {Feature::kScatters},
          .reads = {Field::material},
          .resolve = ByFeature<Feature::kLights, Route<true>, Route<false>>};
}

LANELIGHT_END_KERNELS
