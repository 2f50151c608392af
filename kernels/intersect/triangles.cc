// Closest hit on triangles.
#include "kernels/simd/each_target-inl.h"

#include <algorithm>

#include "kernels/intersect/few-inl.h"
#include "kernels/intersect/frustum_trial.h"
#include "kernels/intersect/packet-inl.h"
#include "kernels/intersect/packet_instances-inl.h"
#include "kernels/intersect/stream-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

LANELIGHT_BEGIN_KERNELS

// World triangles, batch by batch: through a frustum if the rays are nearly the same,
// else the plain loop if there are few triangles, else collected to a stream.
template <bool kAlpha>
void IntersectWorld(Wave& wave) {
  const Accel& accel = wave.scene->accel;
  FrustumTrial frustum(accel);
  auto& stream = RayStream<false, kAlpha, false>::OfThread(*wave.scene);
  const auto flush = [&]() HWY_ATTR { stream.Closest(wave.path); };
  ForEachBatch(wave, wave.queue(QueueId::kActive),
               [&](const Slots& slots, MF valid) HWY_ATTR {
                 Rays rays = LoadRays(wave.path, slots);
                 rays.from = StartsOf(wave.path, slots, rays.t_max);
                 PacketBounds bounds;
                 if (bounds.Compute(rays) && bounds.IsNarrow(accel.groups[0].reach) &&
                     frustum.IsOn()) {
                   int left = frustum.most();
                   ClosestFrustum<kAlpha>(wave, rays, bounds, slots, left);
                   frustum.Add(left);
                   if (left >= 0) return;
                   rays.t_max = Gather(wave.path.t, slots);
                 }
                 if (!accel.few.triangles.empty())
                   return ClosestFew<kAlpha>(wave, rays, slots);
                 stream.Add(rays, slots, Gather(wave.path.prim, slots), valid, flush);
               });
  if (!stream.empty()) flush();
}

// World and instances: through frustums if the rays are nearly the same, else in a
// stream.
template <bool kAlpha>
void IntersectInstanced(Wave& wave) {
  const Accel& accel = wave.scene->accel;
  const float reach = std::max(accel.groups[0].reach, accel.top.reach);
  FrustumTrial frustum(accel);
  auto& stream = RayStream<false, kAlpha, true>::OfThread(*wave.scene);
  const auto flush = [&]() HWY_ATTR { stream.Closest(wave.path); };
  ForEachBatch(wave, wave.queue(QueueId::kActive),
               [&](const Slots& slots, MF valid) HWY_ATTR {
                 Rays rays = LoadRays(wave.path, slots);
                 rays.from = StartsOf(wave.path, slots, rays.t_max);
                 PacketBounds bounds;
                 if (bounds.Compute(rays) && bounds.IsNarrow(reach) && frustum.IsOn()) {
                   int left = frustum.most();
                   ClosestFrustumInstanced<kAlpha>(wave, rays, bounds, slots, left);
                   frustum.Add(left);
                   if (left >= 0) return;
                   rays.t_max = Gather(wave.path.t, slots);
                 }
                 stream.Add(rays, slots, Gather(wave.path.prim, slots), valid, flush);
               });
  if (!stream.empty()) flush();
}

Stage IntersectTrianglesStage() {
  return {.name = "intersect_triangles",
          .meaning = "closest hit on triangles",
          .input = QueueId::kActive,
          .needs = {Feature::kTriangles},
          .reads = kClosestRay | FieldSet{Field::prim},
          .writes = fields::kHit,
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? IntersectInstanced<true> : IntersectInstanced<false>;
            }
            return alpha ? IntersectWorld<true> : IntersectWorld<false>;
          }};
}

LANELIGHT_END_KERNELS
