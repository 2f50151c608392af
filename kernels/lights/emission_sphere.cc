// Emission of hit spheres, weighted against light sampling of the same point.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_sphere.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMis>
void EmissionSphere(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  const PrimitiveRanges& ranges = scene.geometry.ranges;
  const VI begin = hn::Set(DI(), static_cast<int32_t>(ranges.spheres));
  const VI before = hn::Sub(begin, hn::Set(DI(), 1));
  const VI end = hn::Set(DI(), static_cast<int32_t>(ranges.disks));
  const int32_t* words = reinterpret_cast<const int32_t*>(scene.geometry.spheres.data());
  const auto light_of = [&](VI index) HWY_ATTR {
    return Gather(words + offsetof(SphereRecord, light) / 4,
                  hn::Mul(index, hn::Set(DI(), 16)));
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
    const V3 o = Gather3(p.o_x, p.o_y, p.o_z, slots);
    const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
    const VF t = Gather(p.t, slots);
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
      weight =
          EmissionWeight(wave.run->mis, Gather(p.bsdf_pdf, slots),
                         hn::IfThenElse(OutsideSphere(sphere.radius, d2), cone, area));
    }
    AddRadiance(p, slots, IfThenElseZero(facing, Mul(light.Radiance(), weight)));
  });
}

void EmissionSphereMis(Wave& wave) { EmissionSphere<true>(wave); }
void EmissionSpherePlain(Wave& wave) { EmissionSphere<false>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(EmissionSphereMis);
HWY_EXPORT(EmissionSpherePlain);

Stage EmissionSphereStage() {
  return EmissionStage("emission_sphere", "adds the emission of hit spheres",
                       Feature::kSphereLights, [](const FeatureSet& features) -> StageFn {
                         return features.Has(Feature::kMis)
                                    ? HWY_DYNAMIC_DISPATCH(EmissionSphereMis)
                                    : HWY_DYNAMIC_DISPATCH(EmissionSpherePlain);
                       });
}

}  // namespace lanelight
#endif  // HWY_ONCE
