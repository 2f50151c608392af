// Light samples on emitting triangles: uniform over the area; or over the solid angle
// unless that is too small (light-points=solid-angle); or with a warp by the cosine at
// the receiver (light-points=projected).
//   density     pdf_area = pmf / area, pdf_sa = pdf_area d^2 / |cos|; or
//               pdf_sa = pmf / omega; or pdf_sa = pmf b(u) / omega (flat-inl.h)
//   variance    by solid angle no noise is left of the distance and of the cosine at
//               the light; by the warp little of the cosine at the receiver
//   cost        by solid angle, an arctangent and a sine more; of the warp, three roots
//               and four divisions, and at hits an arctangent and five roots
//   source      Turk 1990, "Generating Random Points in Triangles" (square-root warp);
//               Arvo 1995 (kernels/warp/spherical_triangle-inl.h)
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light_stage.h"
#include "kernels/lights/sample_flat-inl.h"
#include "src/scene/compiled/lights.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

// The data of a batch's lights that a sample needs.
struct TriangleEmitters {
  LightTriangle triangle;
  V3 radiance;
  VF pmf, area;
  VI two_sided;

  HWY_INLINE TriangleEmitters(const SceneParts& scene, const Lights& light, VI prim,
                              VF selection)
      : triangle(scene, prim),
        radiance(light.Radiance()),
        pmf(selection),
        area(light.Area()),
        two_sided(light.I(offsetof(LightRecord, two_sided))) {}

  HWY_INLINE V3 normal() const { return triangle.n; }
  HWY_INLINE MF TwoSided() const {
    return hn::RebindMask(DF(), hn::Ne(two_sided, hn::Zero(DI())));
  }
  HWY_INLINE SeenTriangle SeenFrom(V3 p) const { return {triangle, p}; }
  HWY_INLINE V3 ByArea(VF u0, VF u1) const {
    const VF root = hn::Sqrt(u0);
    const VF b1 = hn::Sub(Splat(1.0f), root), b2 = hn::Mul(root, u1);
    return MulAdd(triangle.e1, b1, MulAdd(triangle.e2, b2, triangle.p0));
  }

  /// One for each of the scene's lights, which fit into a vector.
  HWY_INLINE static TriangleEmitters All(const Wave& wave) {
    const DI di;
    const SceneParts& scene = wave;
    const auto last = static_cast<int32_t>(scene.lights->lights.size()) - 1;
    const VI index = hn::Min(hn::Iota(di, 0), hn::Set(di, last));
    const Lights light(scene, index);
    const auto shape = hn::Eq(light.I(offsetof(LightRecord, shape)),
                              hn::Set(di, static_cast<int32_t>(LightShape::kTriangle)));
    return {scene, light, hn::IfThenElseZero(shape, light.Primitive()),
            Gather(wave.chances->pmf.data(), index)};
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

struct TriangleSampling {
  template <bool kMany, LightPoints kPoints>
  static void Sample(Wave& wave) {
    const PathColumns& p = wave.path;
    const SceneParts& scene = wave;
    if (scene.lights->lights.size() <= hn::Lanes(DF()) && p.light_pmf == nullptr) {
      // Records are read once per call; batches choose among them in registers.
      const TriangleEmitters all = TriangleEmitters::All(wave);
      ForEachLit<kMany>(wave, LightShape::kTriangle,
                        [&](const StoreSlots& slots, VI index) HWY_ATTR {
                          SampleFlatLight<kPoints>(p, slots, all.Choose(index));
                        });
      return;
    }
    ForEachLit<kMany>(
        wave, LightShape::kTriangle, [&](const StoreSlots& slots, VI index) HWY_ATTR {
          const Lights light(scene, index);
          SampleFlatLight<kPoints>(
              p, slots,
              TriangleEmitters(scene, light, light.Primitive(), Pmf(wave, slots, index)));
        });
  }
};

Stage SampleTriangleLightStage() {
  return SampleLightStage("light_triangle", "samples emitting triangles",
                          Feature::kTriangleLights, ResolveSampleFlat<TriangleSampling>);
}

LANELIGHT_END_KERNELS
