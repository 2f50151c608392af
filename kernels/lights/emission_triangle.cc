// Emission of hit triangles, weighted against light sampling of the same point.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_triangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMis>
void EmissionTriangle(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  const VI end = hn::Set(DI(), static_cast<int32_t>(scene.geometry.ranges.spheres));
  const int32_t* words =
      reinterpret_cast<const int32_t*>(scene.geometry.triangles.data());
  const auto light_of = [&](VI prim) HWY_ATTR {
    return Gather(words + offsetof(TriangleRecord, light) / 4,
                  hn::Mul(prim, hn::Set(DI(), 12)));
  };
  const PrimitiveSpan lit = EmittingSpan(scene.lights);
  const VI begin = hn::Set(DI(), static_cast<int32_t>(lit.first));
  const VI last = hn::Set(DI(), static_cast<int32_t>(lit.last));
  const Queue& mine =
      FilterQueue(wave, wave.queue(QueueId::kHit), [&](const Slots& slots) HWY_ATTR {
        const VI prim = Gather(p.prim, slots);
        const auto outside = hn::Or(hn::Lt(prim, begin), hn::Gt(prim, last));
        const auto triangle = hn::AndNot(outside, hn::Lt(prim, end));
        if (hn::AllFalse(DI(), triangle)) return hn::RebindMask(DF(), triangle);
        const VI safe = hn::IfThenElseZero(triangle, prim);
        return hn::RebindMask(
            DF(), hn::And(triangle, hn::Gt(light_of(safe), hn::Set(DI(), -1))));
      });
  ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(p.prim, slots);
    const Lights light(scene, light_of(prim));
    const LightTriangle triangle(scene, prim);
    const VF cosine = hn::Neg(Dot(triangle.n, Gather3(p.d_x, p.d_y, p.d_z, slots)));
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

void EmissionTriangleMis(Wave& wave) { EmissionTriangle<true>(wave); }
void EmissionTrianglePlain(Wave& wave) { EmissionTriangle<false>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(EmissionTriangleMis);
HWY_EXPORT(EmissionTrianglePlain);

Stage EmissionTriangleStage() {
  return EmissionStage(
      "emission_triangle", "adds the emission of hit triangles", Feature::kTriangleLights,
      [](const FeatureSet& features) -> StageFn {
        return features.Has(Feature::kMis) ? HWY_DYNAMIC_DISPATCH(EmissionTriangleMis)
                                           : HWY_DYNAMIC_DISPATCH(EmissionTrianglePlain);
      });
}

}  // namespace lanelight
#endif  // HWY_ONCE
