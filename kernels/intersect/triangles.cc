// Closest hit on triangles.
#include "kernels/simd/each_target-inl.h"

#include <algorithm>

#include "kernels/intersect/few-inl.h"
#include "kernels/intersect/frustum_trial.h"
#include "kernels/intersect/packet-inl.h"
#include "kernels/intersect/packet_instances-inl.h"
#include "kernels/intersect/stream-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/geometry/accel.h"

LANELIGHT_BEGIN_KERNELS

// Batch by batch: through a frustum (with instances, one in each space) if the rays are
// nearly the same, else the plain loop if there are few triangles, else collected to a
// stream.
template <bool kAlpha, bool kInstances>
void IntersectRays(Wave& wave) {
  const Accel& accel = *wave.accel;
  float reach = accel.groups[0].reach;
  if constexpr (kInstances) reach = std::max(reach, accel.top.reach);
  FrustumTrial frustum(accel);
  auto& stream = RayStream<false, kAlpha, kInstances>::OfThread(wave);
  const auto flush = [&]() HWY_ATTR { stream.Closest(wave.path); };
  ForEachBatch(wave, wave.queue(QueueId::kActive),
               [&](const Slots& slots, MF valid) HWY_ATTR {
                 Rays rays = LoadRays(wave.path, slots);
                 rays.from = StartsOf(wave.path, slots, rays.t_max);
                 PacketBounds bounds;
                 if (bounds.Compute(rays) && bounds.IsNarrow(reach) && frustum.IsOn()) {
                   int left = frustum.max_leaves();
                   if constexpr (kInstances) {
                     ClosestFrustumInstanced<kAlpha>(wave, rays, bounds, slots, left);
                   } else {
                     ClosestFrustum<kAlpha>(wave, rays, bounds, slots, left);
                   }
                   frustum.Add(left);
                   if (left >= 0) return;
                   rays.t_max = Gather(wave.path.t, slots);
                 }
                 if (!kInstances && !accel.few.triangles.empty()) {
                   return ClosestFew<kAlpha>(wave, rays, slots);
                 }
                 stream.Add(rays, slots, Gather(wave.path.prim, slots), valid, flush);
               });
  if (!stream.empty()) flush();
}

Stage IntersectTrianglesStage() {
  return {.name = "intersect_triangles",
          .meaning = "closest hit on triangles",
          .input = QueueId::kActive,
          .role = StageRole::kIntersect,
          .needs = {Feature::kTriangles},
          .reads = kClosestRay | FieldSet{Field::prim, Field::time},
          .writes = fields::kHit,
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? IntersectRays<true, true> : IntersectRays<false, true>;
            }
            return alpha ? IntersectRays<true, false> : IntersectRays<false, false>;
          }};
}

LANELIGHT_END_KERNELS
