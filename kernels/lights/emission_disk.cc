// Emission of hit disks, weighted against light sampling of the same point.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_disk.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMis>
void EmissionDisk(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  const PrimitiveRanges& ranges = scene.geometry.ranges;
  const VI begin = hn::Set(DI(), static_cast<int32_t>(ranges.disks));
  const VI before = hn::Sub(begin, hn::Set(DI(), 1));
  const VI end = hn::Set(DI(), static_cast<int32_t>(ranges.planes));
  const int32_t* words = reinterpret_cast<const int32_t*>(scene.geometry.disks.data());
  const auto light_of = [&](VI index) HWY_ATTR {
    return Gather(words + offsetof(DiskRecord, light) / 4,
                  hn::Mul(index, hn::Set(DI(), 16)));
  };
  const Queue& mine =
      FilterQueue(wave, wave.queue(QueueId::kHit), [&](const Slots& slots) HWY_ATTR {
        const VI prim = Gather(p.prim, slots);
        const auto disk = hn::And(hn::Gt(prim, before), hn::Lt(prim, end));
        const VI safe = hn::IfThenElseZero(disk, hn::Sub(prim, begin));
        return hn::RebindMask(DF(),
                              hn::And(disk, hn::Gt(light_of(safe), hn::Set(DI(), -1))));
      });
  ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(p.prim, slots);
    const Lights light(scene, light_of(hn::Sub(prim, begin)));
    const LightDisk disk(scene, prim);
    const VF cosine = hn::Neg(Dot(disk.n, Gather3(p.d_x, p.d_y, p.d_z, slots)));
    const MF facing = hn::Or(hn::Gt(cosine, Splat(0)), light.TwoSided());
    VF weight = Splat(1.0f);
    if constexpr (kMis) {
      const VF t = Gather(p.t, slots);
      const VF pdf = hn::Div(hn::Mul(hn::Mul(light.Pmf(p, slots), t), t),
                             hn::Mul(light.Area(), hn::Abs(cosine)));
      weight = EmissionWeight(wave.run->mis, Gather(p.bsdf_pdf, slots), pdf);
    }
    AddRadiance(p, slots, IfThenElseZero(facing, Mul(light.Radiance(), weight)));
  });
}

void EmissionDiskMis(Wave& wave) { EmissionDisk<true>(wave); }
void EmissionDiskPlain(Wave& wave) { EmissionDisk<false>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(EmissionDiskMis);
HWY_EXPORT(EmissionDiskPlain);

Stage EmissionDiskStage() {
  return EmissionStage("emission_disk", "adds the emission of hit disks",
                       Feature::kDiskLights, [](const FeatureSet& features) -> StageFn {
                         return features.Has(Feature::kMis)
                                    ? HWY_DYNAMIC_DISPATCH(EmissionDiskMis)
                                    : HWY_DYNAMIC_DISPATCH(EmissionDiskPlain);
                       });
}

}  // namespace lanelight
#endif  // HWY_ONCE
