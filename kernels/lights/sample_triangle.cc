// Light samples on emitting triangles: uniform over the area.
//   density     pdf_area = pmf / area; pdf_sa = pdf_area d^2 / |cos|
//   source      Turk 1990, "Generating Random Points in Triangles" (square-root warp)
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_triangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

// What a sample needs of the lights of a batch.
struct TriangleEmitters {
  LightTriangle triangle;
  V3 radiance;
  VF pdf_area;
  VI two_sided;

  HWY_INLINE TriangleEmitters(const CompiledScene& scene, const Lights& light, VI prim,
                              VF pmf)
      : triangle(scene, prim),
        radiance(light.Radiance()),
        pdf_area(hn::Div(pmf, light.Area())),
        two_sided(light.I(offsetof(LightRecord, two_sided))) {}

  /// One for each of the scene's lights, which fit into a vector.
  HWY_INLINE static TriangleEmitters All(const CompiledScene& scene) {
    const DI di;
    const auto last = static_cast<int32_t>(scene.lights.lights.size()) - 1;
    const Lights light(scene, hn::Min(hn::Iota(di, 0), hn::Set(di, last)));
    const auto shape = hn::Eq(light.I(offsetof(LightRecord, shape)),
                              hn::Set(di, static_cast<int32_t>(LightShape::kTriangle)));
    return {scene, light, hn::IfThenElseZero(shape, light.Primitive()),
            light.F(offsetof(LightRecord, pmf))};
  }

  HWY_INLINE TriangleEmitters Choose(VI light) const {
    const DF df;
    const auto at = hn::IndicesFromVec(df, light);
    const auto pick = [&](V3 v) HWY_ATTR {
      return V3{hn::TableLookupLanes(v.x, at), hn::TableLookupLanes(v.y, at),
                hn::TableLookupLanes(v.z, at)};
    };
    TriangleEmitters chosen = *this;
    LightTriangle& t = chosen.triangle;
    t.p0 = pick(t.p0);
    t.e1 = pick(t.e1);
    t.e2 = pick(t.e2);
    t.n = pick(t.n);
    chosen.radiance = pick(radiance);
    chosen.pdf_area = hn::TableLookupLanes(pdf_area, at);
    const VF sides = hn::TableLookupLanes(hn::BitCast(df, two_sided), at);
    chosen.two_sided = hn::BitCast(DI(), sides);
    return chosen;
  }
};

HWY_INLINE void SampleEmitters(const PathColumns& p, const StoreSlots& slots,
                               const TriangleEmitters& light) {
  const LightTriangle& triangle = light.triangle;
  const VF root = hn::Sqrt(Gather(p.u_light_0, slots));
  const VF b1 = hn::Sub(Splat(1.0f), root);
  const VF b2 = hn::Mul(root, Gather(p.u_light_1, slots));
  const V3 q = MulAdd(triangle.e1, b1, MulAdd(triangle.e2, b2, triangle.p0));
  const MF two_sided = hn::RebindMask(DF(), hn::Ne(light.two_sided, hn::Zero(DI())));
  StoreSurfaceSample(p, slots, q, triangle.n, light.pdf_area, light.radiance, two_sided);
}

template <bool kMany>
void SampleTriangleLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  if (scene.lights.lights.size() <= hn::Lanes(DF()) && p.light_pmf == nullptr) {
    // Records are read once per call; batches choose among them in registers.
    const TriangleEmitters all = TriangleEmitters::All(scene);
    ForEachLit<kMany>(wave, LightShape::kTriangle,
                      [&](const StoreSlots& slots, VI index)
                          HWY_ATTR { SampleEmitters(p, slots, all.Choose(index)); });
    return;
  }
  ForEachLit<kMany>(
      wave, LightShape::kTriangle, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(scene, index);
        SampleEmitters(p, slots, {scene, light, light.Primitive(), light.Pmf(p, slots)});
      });
}

void SampleTriangleLightOne(Wave& wave) { SampleTriangleLight<false>(wave); }
void SampleTriangleLightMany(Wave& wave) { SampleTriangleLight<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SampleTriangleLightOne);
HWY_EXPORT(SampleTriangleLightMany);

Stage SampleTriangleLightStage() {
  return SampleLightStage("light_triangle", "samples emitting triangles",
                          Feature::kTriangleLights,
                          [](const FeatureSet& features) -> StageFn {
                            return features.Has(Feature::kManyLights)
                                       ? HWY_DYNAMIC_DISPATCH(SampleTriangleLightMany)
                                       : HWY_DYNAMIC_DISPATCH(SampleTriangleLightOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
