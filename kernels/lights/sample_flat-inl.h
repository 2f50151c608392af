// Light samples on emitting triangles and rectangles, by light-points.
#ifndef LANELIGHT_LIGHTS_SAMPLE_FLAT_INL_H_
#define LANELIGHT_LIGHTS_SAMPLE_FLAT_INL_H_

#include "kernels/lights/flat-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/vocabulary/strategy/choices.h"

LANELIGHT_BEGIN_KERNELS

/// The shading normal of the vertex, on the side that the path comes from.
LANELIGHT_INLINE V3 FacingNormal(const PathColumns& p, const Slots& slots) {
  const V3 n = p.ns_x != nullptr ? Gather3(p.ns_x, p.ns_y, p.ns_z, slots)
                                 : Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
  const VF away = Dot(n, Gather3(p.d_x, p.d_y, p.d_z, slots));
  return Mul(n, hn::CopySign(Splat(1.0f), hn::Neg(away)));
}

/// Emitters: lights of a batch, with
///   normal, radiance, pmf, area, TwoSided()
///   ByArea(u0, u1)   a point on them, uniform over the area
///   SeenFrom(p)      as flat-inl.h says
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

/// Shape::Sample<kMany, kPoints>, for the features of a plan.
template <class Shape>
StageFn ResolveSampleFlat(const FeatureSet& features) {
  const bool many = features.Has(Feature::kManyLights);
  const auto kernel = [&](auto points) -> StageFn {
    return many ? Shape::template Sample<true, decltype(points)::value>
                : Shape::template Sample<false, decltype(points)::value>;
  };
  using enum LightPoints;
  if (features.Has(Feature::kProjectedLights)) {
    return kernel(std::integral_constant<LightPoints, kProjected>());
  }
  if (features.Has(Feature::kSolidAngleLights)) {
    return kernel(std::integral_constant<LightPoints, kSolidAngle>());
  }
  return kernel(std::integral_constant<LightPoints, kArea>());
}

LANELIGHT_END_KERNELS

#endif
