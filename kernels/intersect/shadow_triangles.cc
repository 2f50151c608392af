// Shadow rays against triangles.
#include "kernels/simd/each_target-inl.h"

#include "kernels/intersect/few-inl.h"
#include "kernels/intersect/packet-inl.h"
#include "kernels/intersect/stream-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

// Rays are traced as in triangles.cc. They stay in order: the queue is written behind the
// place where it is read, at most a stream later.
template <bool kAlpha, bool kInstances>
void ShadowRays(Wave& wave) {
  const SceneParts& scene = wave;
  const Queue all = wave.queue(QueueId::kShadow);
  Queue& kept = wave.queue(QueueId::kShadow);
  kept.size = 0;
  auto& stream = RayStream<true, kAlpha, kInstances>::OfThread(wave);
  const auto flush = [&]() HWY_ATTR { stream.KeepOpen(kept); };
  const bool few = !kInstances && !scene.accel->few.triangles.empty();
  ForEachBatch(wave, all, [&](const Slots& slots, MF valid) HWY_ATTR {
    Rays rays = LoadShadowRays(wave.path, slots);
    rays.from = Gather(wave.path.prim, slots);
    if (few) {
      PacketBounds bounds;
      const bool narrow =
          bounds.Compute(rays) && bounds.IsNarrow(scene.accel->groups[0].reach);
      const MF blocked = narrow ? BlockedFrustum<kAlpha>(scene, rays, bounds)
                                : BlockedFew<kAlpha>(scene, rays);
      return Push(kept, slots, hn::AndNot(blocked, valid));
    }
    stream.Add(rays, slots, hn::Zero(DI()), valid, flush);
  });
  if (!stream.empty()) flush();
}

Stage ShadowTrianglesStage() {
  return {.name = "shadow_triangles",
          .meaning = "removes shadow rays blocked by triangles",
          .input = QueueId::kShadow,
          .role = StageRole::kShadow,
          .needs = {Feature::kTriangles, Feature::kLights, Feature::kOpaqueShadows},
          .reads = kShadowRay | FieldSet{Field::prim, Field::time},
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? ShadowRays<true, true> : ShadowRays<false, true>;
            }
            return alpha ? ShadowRays<true, false> : ShadowRays<false, false>;
          }};
}

LANELIGHT_END_KERNELS
