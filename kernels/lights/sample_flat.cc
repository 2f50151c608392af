// Light samples on emitting triangles and rectangles: uniform over the area; or over the
// solid angle unless that is too small (light-points=solid-angle); or with a warp by the
// cosine at the receiver (light-points=projected).
//   density     pdf_area = pmf / area, pdf_sa = pdf_area d^2 / |cos|; or
//               pdf_sa = pmf / omega; or pdf_sa = pmf b(u) / omega (flat-inl.h)
//   variance    by solid angle no noise is left of the distance and of the cosine at
//               the light; by the warp little of the cosine at the receiver. Rectangles
//               need no choice between their halves, which keeps the strata of points
//   cost        by solid angle, an arctangent and a sine more; of the warp, three roots
//               and four divisions, and at hits an arctangent and five roots
//   source      Turk 1990, "Generating Random Points in Triangles" (square-root warp);
//               Arvo 1995 (kernels/warp/spherical_triangle-inl.h); Urena, Fajardo and
//               King 2013 (kernels/warp/spherical_rectangle-inl.h)
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/flat-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/compiled/lights.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

// The shading normal of the vertex, on the side that the path comes from.
HWY_INLINE V3 FacingNormal(const PathColumns& p, const Slots& slots) {
  const V3 n = p.ns_x != nullptr ? Gather3(p.ns_x, p.ns_y, p.ns_z, slots)
                                 : Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
  const VF away = Dot(n, Gather3(p.d_x, p.d_y, p.d_z, slots));
  return Mul(n, hn::CopySign(Splat(1.0f), hn::Neg(away)));
}

// Emitters: lights of a batch, with
//   normal, radiance, pmf, area, TwoSided()
//   ByArea(u0, u1)   a point on them, uniform over the area
//   SeenFrom(p)      a VisibleTriangle or VisibleRectangle (flat-inl.h)
template <LightPoints kPoints, class Emitters>
HWY_INLINE void SampleFlatLight(const PathColumns& p, const StoreSlots& slots,
                                const Emitters& light) {
  UnitSquarePoint u = {Gather(p.u_light_0, slots), Gather(p.u_light_1, slots)};
  V3 q = light.ByArea(u.u0, u.u1);
  VF angle_pdf = Splat(0);
  MF by_angle = hn::Gt(angle_pdf, angle_pdf);
  if constexpr (kPoints != LightPoints::kArea) {
    const auto seen = light.SeenFrom(Gather3(p.p_x, p.p_y, p.p_z, slots));
    by_angle = BySolidAngle(seen.omega);
    angle_pdf = hn::Div(light.pmf, seen.omega);
    if constexpr (kPoints == LightPoints::kProjected) {
      const Bilinear weights = seen.Weights(FacingNormal(p, slots));
      u = weights.Sample(u.u0, u.u1);
      angle_pdf = hn::Mul(angle_pdf, weights.Pdf(u));
    }
    q = IfThenElse(by_angle, seen.At(u), q);
  }
  const ShadowRay ray(p, slots, q, light.normal());
  VF pdf_sa = ray.PdfSa(hn::Div(light.pmf, light.area));
  if constexpr (kPoints != LightPoints::kArea) {
    // A receiver on the light itself would find it all around, half a sphere of it: the
    // ray then starts within the clearance at which it ends, and seems to come from the
    // other side.
    const V3 away = Gather3(p.p_x, p.p_y, p.p_z, slots) - q;
    const MF clear = hn::Gt(hn::Mul(Dot(light.normal(), away), ray.cos_light), Splat(0));
    pdf_sa = hn::IfThenElseZero(clear, hn::IfThenElse(by_angle, angle_pdf, pdf_sa));
  }
  StoreShadowRay(p, slots, ray, pdf_sa, {light.radiance, light.TwoSided()});
}

// Shape::Sample<kMany, kPoints> for the features of a plan.
template <class Shape>
StageFn ResolveSampleFlat(const FeatureSet& features) {
  return ByLightPoints(features, Feature::kProjectedLights, [&](auto points) -> StageFn {
    return features.Has(Feature::kManyLights)
               ? Shape::template Sample<true, decltype(points)::value>
               : Shape::template Sample<false, decltype(points)::value>;
  });
}

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
  HWY_INLINE VisibleTriangle SeenFrom(V3 p) const { return {triangle, p}; }
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
    const auto at = hn::IndicesFromVec(DF(), light);
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
    const VF sides = hn::TableLookupLanes(hn::BitCast(DF(), two_sided), at);
    chosen.two_sided = hn::BitCast(DI(), sides);
    return chosen;
  }
};

struct TriangleSampling {
  template <bool kMany, LightPoints kPoints>
  static void Sample(Wave& wave) {
    const PathColumns& p = wave.path;
    const SceneParts& scene = wave;
    if (scene.lights->lights.size() <= hn::Lanes(DF()) && IsPmfConstant(wave)) {
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

struct RectangleEmitters {
  LightRectangle rectangle;
  V3 radiance;
  VF pmf, area;
  MF two_sided;

  HWY_INLINE RectangleEmitters(const Lights& light, VF selection)
      : rectangle(light),
        radiance(light.Radiance()),
        pmf(selection),
        area(light.Area()),
        two_sided(light.TwoSided()) {}

  HWY_INLINE V3 normal() const { return rectangle.n; }
  HWY_INLINE MF TwoSided() const { return two_sided; }
  HWY_INLINE VisibleRectangle SeenFrom(V3 p) const { return {rectangle, p}; }
  HWY_INLINE V3 ByArea(VF u0, VF u1) const {
    return rectangle.At(hn::Mul(u0, rectangle.size_x), hn::Mul(u1, rectangle.size_y));
  }
};

struct RectangleSampling {
  template <bool kMany, LightPoints kPoints>
  static void Sample(Wave& wave) {
    const PathColumns& p = wave.path;
    ForEachLit<kMany>(wave, LightShape::kRectangle,
                      [&](const StoreSlots& slots, VI index) HWY_ATTR {
                        const Lights light(wave, index);
                        SampleFlatLight<kPoints>(
                            p, slots, RectangleEmitters(light, Pmf(wave, slots, index)));
                      });
  }
};

Stage SampleRectangleLightStage() {
  return SampleLightStage("light_rectangle", "samples emitting rectangles",
                          Feature::kRectangleLights,
                          ResolveSampleFlat<RectangleSampling>);
}

LANELIGHT_END_KERNELS
