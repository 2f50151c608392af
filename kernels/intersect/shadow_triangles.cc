// Shadow rays against triangles.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect/shadow_triangles.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/intersect/few-inl.h"
#include "kernels/intersect/packet-inl.h"
#include "kernels/intersect/stream-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

// As in triangles.cc. Rays stay in order: the queue is written behind the place where it
// is read, at most a stream later.
template <bool kAlpha, bool kInstances>
void ShadowRays(Wave& wave) {
  const CompiledScene& scene = *wave.scene;
  const Queue all = wave.queue(QueueId::kShadow);
  Queue& kept = wave.queue(QueueId::kShadow);
  kept.size = 0;
  auto& stream = RayStream<true, kAlpha, kInstances>::OfThread(scene);
  const auto flush = [&]() HWY_ATTR { stream.KeepOpen(kept); };
  const bool few = !kInstances && !scene.accel.few.triangles.empty();
  ForEachBatch(wave, all, [&](const Slots& slots, MF valid) HWY_ATTR {
    Rays rays = LoadShadowRays(wave.path, slots);
    rays.from = Gather(wave.path.prim, slots);
    if (few) {
      PacketBounds bounds;
      const bool narrow =
          bounds.Compute(rays) && bounds.IsNarrow(scene.accel.groups[0].reach);
      const MF blocked = narrow ? BlockedFrustum<kAlpha>(scene, rays, bounds)
                                : BlockedFew<kAlpha>(scene, rays);
      return Push(kept, slots, hn::AndNot(blocked, valid));
    }
    stream.Add(rays, slots, hn::Zero(DI()), valid, flush);
  });
  if (!stream.empty()) flush();
}

void ShadowWorld(Wave& wave) { ShadowRays<false, false>(wave); }
void ShadowWorldAlpha(Wave& wave) { ShadowRays<true, false>(wave); }
void ShadowInstanced(Wave& wave) { ShadowRays<false, true>(wave); }
void ShadowInstancedAlpha(Wave& wave) { ShadowRays<true, true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/intersect/stages.h"

namespace lanelight {
HWY_EXPORT(ShadowWorld);
HWY_EXPORT(ShadowWorldAlpha);
HWY_EXPORT(ShadowInstanced);
HWY_EXPORT(ShadowInstancedAlpha);

Stage ShadowTrianglesStage() {
  return {.name = "shadow_triangles",
          .meaning = "drop shadow rays blocked by triangles",
          .input = QueueId::kShadow,
          .needs = {Feature::kTriangles, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields() | FieldSet{Field::prim},
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? HWY_DYNAMIC_DISPATCH(ShadowInstancedAlpha)
                           : HWY_DYNAMIC_DISPATCH(ShadowInstanced);
            }
            return alpha ? HWY_DYNAMIC_DISPATCH(ShadowWorldAlpha)
                         : HWY_DYNAMIC_DISPATCH(ShadowWorld);
          }};
}

}  // namespace lanelight
#endif
