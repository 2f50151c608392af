// Light samples on emitting triangles: uniform over the area, or over the solid angle
// (light-points=solid-angle) where that is not too small.
//   density     pdf_area = pmf / area, pdf_sa = pdf_area d^2 / |cos|; or
//               pdf_sa = pmf / omega
//   variance    by solid angle no noise is left of the distance and of the cosine at
//               the light
//   cost        by solid angle, an arctangent and a sine more
//   source      Turk 1990, "Generating Random Points in Triangles" (square-root warp);
//               Arvo 1995 (kernels/warp/spherical_triangle-inl.h)
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_triangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/warp/spherical_triangle-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

// What a sample needs of the lights of a batch.
struct TriangleEmitters {
  LightTriangle triangle;
  V3 radiance;
  VF pmf, area;
  VI two_sided;

  HWY_INLINE TriangleEmitters(const CompiledScene& scene, const Lights& light, VI prim,
                              VF selection)
      : triangle(scene, prim),
        radiance(light.Radiance()),
        pmf(selection),
        area(light.Area()),
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
    chosen.pmf = hn::TableLookupLanes(pmf, at);
    chosen.area = hn::TableLookupLanes(area, at);
    const VF sides = hn::TableLookupLanes(hn::BitCast(df, two_sided), at);
    chosen.two_sided = hn::BitCast(DI(), sides);
    return chosen;
  }
};

HWY_INLINE V3 UniformPoint(const LightTriangle& triangle, VF u0, VF u1) {
  const VF root = hn::Sqrt(u0);
  const VF b1 = hn::Sub(Splat(1.0f), root), b2 = hn::Mul(root, u1);
  return MulAdd(triangle.e1, b1, MulAdd(triangle.e2, b2, triangle.p0));
}

// Where the direction through a triangle meets its plane. Rounding at a grazing angle
// must not put it farther away than the farthest corner.
HWY_INLINE V3 PointBehind(const LightTriangle& triangle, V3 from, V3 direction) {
  const V3 p0 = triangle.p0 - from;
  const V3 p1 = p0 + triangle.e1, p2 = p0 + triangle.e2;
  const VF far2 = hn::Max(Dot(p0, p0), hn::Max(Dot(p1, p1), Dot(p2, p2)));
  const VF distance = hn::Abs(hn::Div(Dot(p0, triangle.n), Dot(direction, triangle.n)));
  return MulAdd(direction, hn::Min(distance, hn::Sqrt(far2)), from);
}

template <bool kSolidAngle>
HWY_INLINE void SampleEmitters(const PathColumns& p, const StoreSlots& slots,
                               const TriangleEmitters& light) {
  const LightTriangle& triangle = light.triangle;
  const VF u0 = Gather(p.u_light_0, slots), u1 = Gather(p.u_light_1, slots);
  V3 q = UniformPoint(triangle, u0, u1);
  VF omega = Splat(0);
  if constexpr (kSolidAngle) {
    const V3 from = Gather3(p.p_x, p.p_y, p.p_z, slots);
    const SphericalTriangle seen(triangle.p0 - from, triangle.e1, triangle.e2);
    omega = seen.SolidAngle();
    const V3 direction = SampleSphericalTriangle(seen, omega, u0, u1);
    q = IfThenElse(BySolidAngle(omega), PointBehind(triangle, from, direction), q);
  }
  const ShadowRay ray(p, slots, q, triangle.n);
  VF pdf_sa = ray.PdfSa(hn::Div(light.pmf, light.area));
  if constexpr (kSolidAngle) {
    pdf_sa = hn::IfThenElse(BySolidAngle(omega), hn::Div(light.pmf, omega), pdf_sa);
  }
  const MF two_sided = hn::RebindMask(DF(), hn::Ne(light.two_sided, hn::Zero(DI())));
  StoreShadowRay(p, slots, ray, pdf_sa, light.radiance, two_sided);
}

template <bool kMany, bool kSolidAngle>
void SampleTriangleLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  if (scene.lights.lights.size() <= hn::Lanes(DF()) && p.light_pmf == nullptr) {
    // Records are read once per call; batches choose among them in registers.
    const TriangleEmitters all = TriangleEmitters::All(scene);
    ForEachLit<kMany>(wave, LightShape::kTriangle,
                      [&](const StoreSlots& slots, VI index) HWY_ATTR {
                        SampleEmitters<kSolidAngle>(p, slots, all.Choose(index));
                      });
    return;
  }
  ForEachLit<kMany>(
      wave, LightShape::kTriangle, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(scene, index);
        SampleEmitters<kSolidAngle>(
            p, slots, {scene, light, light.Primitive(), light.Pmf(p, slots)});
      });
}

void SampleTriangleLightOne(Wave& wave) { SampleTriangleLight<false, false>(wave); }
void SampleTriangleLightMany(Wave& wave) { SampleTriangleLight<true, false>(wave); }
void SampleTriangleAngleOne(Wave& wave) { SampleTriangleLight<false, true>(wave); }
void SampleTriangleAngleMany(Wave& wave) { SampleTriangleLight<true, true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SampleTriangleLightOne);
HWY_EXPORT(SampleTriangleLightMany);
HWY_EXPORT(SampleTriangleAngleOne);
HWY_EXPORT(SampleTriangleAngleMany);

Stage SampleTriangleLightStage() {
  return SampleLightStage("light_triangle", "samples emitting triangles",
                          Feature::kTriangleLights,
                          [](const FeatureSet& features) -> StageFn {
                            const bool many = features.Has(Feature::kManyLights);
                            if (features.Has(Feature::kSolidAngleLights)) {
                              return many ? HWY_DYNAMIC_DISPATCH(SampleTriangleAngleMany)
                                          : HWY_DYNAMIC_DISPATCH(SampleTriangleAngleOne);
                            }
                            return many ? HWY_DYNAMIC_DISPATCH(SampleTriangleLightMany)
                                        : HWY_DYNAMIC_DISPATCH(SampleTriangleLightOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
