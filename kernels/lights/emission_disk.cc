// Emission of hit disks, weighted against light sampling of the same point.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/emission_image-inl.h"
#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/lights/light_stage.h"
#include "src/compiled/scene.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMis, bool kImages>
void EmissionDisk(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  const PrimitiveRanges& ranges = scene.geometry.ranges;
  const VI begin = hn::Set(DI(), static_cast<int32_t>(ranges.disks));
  const VI before = hn::Sub(begin, hn::Set(DI(), 1));
  const VI end = hn::Set(DI(), static_cast<int32_t>(ranges.planes));
  const auto light_of = [&](VI index) HWY_ATTR {
    return RecordWords(scene.geometry.disks.data(), index).I(offsetof(DiskRecord, light));
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
      const VF t = HitDistance(p, slots);
      const VF pdf = hn::Div(hn::Mul(hn::Mul(light.Pmf(p, slots), t), t),
                             hn::Mul(light.Area(), hn::Abs(cosine)));
      weight = EmissionWeight(wave.run->mis, Gather(p.bsdf_pdf, slots), pdf);
    }
    V3 radiance = light.Radiance();
    if constexpr (kImages) {
      radiance = Mul(
          radiance,
          ImageAt(scene, light,
                  DiskUv(scene, prim, disk,
                         MulAdd(Gather3(p.d_x, p.d_y, p.d_z, slots), Gather(p.t, slots),
                                Gather3(p.o_x, p.o_y, p.o_z, slots)) -
                             disk.center)));
    }
    AddRadiance(p, slots, IfThenElseZero(facing, Mul(radiance, weight)));
  });
}

StageFn ResolveEmissionDisk(const FeatureSet& features) {
  const bool images = features.Has(Feature::kEmissionImages);
  if (features.Has(Feature::kMis)) {
    return images ? EmissionDisk<true, true> : EmissionDisk<true, false>;
  }
  return images ? EmissionDisk<false, true> : EmissionDisk<false, false>;
}

Stage EmissionDiskStage() {
  return EmissionStage("emission_disk", "adds the emission of hit disks",
                       Feature::kDiskLights, ResolveEmissionDisk);
}

LANELIGHT_END_KERNELS
