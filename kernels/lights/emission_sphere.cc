// Emission of hit spheres, weighted against light sampling of the same point.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/emission_image-inl.h"
#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/lights/light_stage.h"
#include "src/compiled/scene.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMis, bool kImages>
void EmissionSphere(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  const PrimitiveRanges& ranges = scene.geometry.ranges;
  const VI begin = hn::Set(DI(), static_cast<int32_t>(ranges.spheres));
  const VI before = hn::Sub(begin, hn::Set(DI(), 1));
  const VI end = hn::Set(DI(), static_cast<int32_t>(ranges.disks));
  const auto light_of = [&](VI index) HWY_ATTR {
    return RecordWords(scene.geometry.spheres.data(), index)
        .I(offsetof(SphereRecord, light));
  };
  const Queue& mine =
      FilterQueue(wave, wave.queue(QueueId::kHit), [&](const Slots& slots) HWY_ATTR {
        const VI prim = Gather(p.prim, slots);
        const auto sphere = hn::And(hn::Gt(prim, before), hn::Lt(prim, end));
        const VI safe = hn::IfThenElseZero(sphere, hn::Sub(prim, begin));
        return hn::RebindMask(DF(),
                              hn::And(sphere, hn::Gt(light_of(safe), hn::Set(DI(), -1))));
      });
  ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(p.prim, slots);
    const Lights light(scene, light_of(hn::Sub(prim, begin)));
    const LightSphere sphere(scene, prim);
    const V3 o = ScatteredFrom(p, slots);
    const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
    const VF t = HitDistance(p, slots);
    const V3 n =
        Mul(MulAdd(d, t, o) - sphere.center, hn::Div(sphere.normal_sign, sphere.radius));
    const VF cosine = hn::Neg(Dot(n, d));
    const MF facing = hn::Or(hn::Gt(cosine, Splat(0)), light.TwoSided());
    VF weight = Splat(1.0f);
    if constexpr (kMis) {
      const V3 to_center = sphere.center - o;
      const VF d2 = Dot(to_center, to_center);
      const VF cone = hn::Div(
          light.Pmf(p, slots),
          hn::Mul(Splat(6.28318530717958648f), OneMinusCosCone(sphere.radius, d2)));
      const VF area = hn::Div(hn::Mul(hn::Mul(light.Pmf(p, slots), t), t),
                              hn::Mul(light.Area(), hn::Abs(cosine)));
      weight = EmissionWeight(wave.run->mis, Gather(p.bsdf_pdf, slots),
                              hn::IfThenElse(hn::Gt(d2, light.ConeFrom()), cone, area));
    }
    V3 radiance = light.Radiance();
    if constexpr (kImages) {
      radiance =
          Mul(radiance,
              ImageAt(scene, light, SphereUv(scene, prim, Mul(n, sphere.normal_sign))));
    }
    AddRadiance(p, slots, IfThenElseZero(facing, Mul(radiance, weight)));
  });
}

StageFn ResolveEmissionSphere(const FeatureSet& features) {
  const bool images = features.Has(Feature::kEmissionImages);
  if (features.Has(Feature::kMis)) {
    return images ? EmissionSphere<true, true> : EmissionSphere<true, false>;
  }
  return images ? EmissionSphere<false, true> : EmissionSphere<false, false>;
}

Stage EmissionSphereStage() {
  return EmissionStage("emission_sphere", "adds the emission of hit spheres",
                       Feature::kSphereLights, ResolveEmissionSphere);
}

LANELIGHT_END_KERNELS
