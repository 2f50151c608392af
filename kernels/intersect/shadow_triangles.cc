// Shadow rays against triangles.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect/shadow_triangles.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/intersect/few-inl.h"
#include "kernels/intersect/packet-inl.h"
#include "kernels/intersect/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

// Shadow rays go as packets only through scenes of at most so many triangles: a ray by
// itself stops at its first blocker, a packet only when all its rays have one. Above
// this, packets cost 6.4 times as much per ray on coffee and 1.8 times on dining-room
// (medians of three interleaved renders).
constexpr std::size_t kPacketTriangles = 2048;

// As in triangles.cc.
template <bool kAlpha, bool kInstances>
void ShadowTriangles(Wave& wave) {
  const CompiledScene& scene = *wave.scene;
  const bool packets = scene.geometry.triangles.size() <= kPacketTriangles;
  RemoveOccluded(wave, [&](const Rays& rays, VI slots, MF valid) HWY_ATTR {
    if constexpr (!kInstances) {
      PacketBounds bounds;
      if (packets && bounds.Compute(rays) &&
          bounds.IsNarrow(scene.accel.groups[0].reach)) {
        return BlockedPacket<kAlpha>(scene, rays, bounds);
      }
      if (!scene.accel.few.triangles.empty()) return BlockedFew<kAlpha>(scene, rays);
    }
    const int count = static_cast<int>(hn::CountTrue(DF(), valid));
    return BlockedSingle<kAlpha, kInstances>(scene, rays, slots, count);
  });
}

void ShadowWorld(Wave& wave) { ShadowTriangles<false, false>(wave); }
void ShadowWorldAlpha(Wave& wave) { ShadowTriangles<true, false>(wave); }
void ShadowInstanced(Wave& wave) { ShadowTriangles<false, true>(wave); }
void ShadowInstancedAlpha(Wave& wave) { ShadowTriangles<true, true>(wave); }

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
          .needs = {Feature::kTriangles, Feature::kLights},
          .reads = ShadowRayFields(),
          .writes = {},
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
