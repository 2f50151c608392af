// Light samples on emitting shapes whose radiance is not the same everywhere: where on
// the shape a sample lies, and the loop that multiplies samples by what is there. The
// samplers choose points as if the light were evenly bright; their densities stay.
#ifndef LANELIGHT_LIGHTS_SAMPLED_POINTS_INL_H_
#define LANELIGHT_LIGHTS_SAMPLED_POINTS_INL_H_

#include "kernels/lights/emission_image-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/texture/mapping-inl.h"

LANELIGHT_BEGIN_KERNELS

struct TriangleWeights {
  VF b1, b2;
};

/// Barycentric weights of the point of a triangle's plane that is nearest to q.
LANELIGHT_INLINE TriangleWeights WeightsOf(const LightTriangle& triangle, V3 q) {
  const V3 e1 = triangle.e1, e2 = triangle.e2, d = q - triangle.p0;
  const VF a = Dot(e1, e1), b = Dot(e1, e2), c = Dot(e2, e2);
  const VF along1 = Dot(d, e1), along2 = Dot(d, e2);
  const VF inverse = hn::Div(Splat(1.0f), DifferenceOfProducts(a, c, b, b));
  return {hn::Mul(DifferenceOfProducts(c, along1, b, along2), inverse),
          hn::Mul(DifferenceOfProducts(a, along2, b, along1), inverse)};
}

LANELIGHT_INLINE PlacedPoint PlacedAt(LightUv uv, V3 q, V3 n) {
  return {uv.u, uv.v, q, n};
}

LANELIGHT_INLINE PlacedPoint PointOnTriangle(const SceneParts& scene, const Lights& light,
                                             V3 q) {
  const LightTriangle triangle(scene, light.Primitive());
  const TriangleWeights w = WeightsOf(triangle, q);
  return PlacedAt(TriangleUv(*scene.geometry, light.Primitive(), w.b1, w.b2), q,
                  triangle.n);
}

/// A rectangle's points lie in one triangle or in the other.
LANELIGHT_INLINE PlacedPoint PointOnRectangle(const SceneParts& scene,
                                              const Lights& light, V3 q) {
  const VI first = light.Primitive();
  const VI second = light.I(offsetof(LightRecord, second_primitive));
  const LightTriangle triangle(scene, first);
  const TriangleWeights a = WeightsOf(triangle, q);
  const TriangleWeights b = WeightsOf(LightTriangle(scene, second), q);
  const auto least = [](const TriangleWeights& w) HWY_ATTR {
    const VF b0 = hn::Sub(hn::Sub(Splat(1.0f), w.b1), w.b2);
    return hn::Min(b0, hn::Min(w.b1, w.b2));
  };
  const MF in_first = hn::Ge(least(a), least(b));
  const VI prim = hn::IfThenElse(hn::RebindMask(DI(), in_first), first, second);
  const LightUv uv =
      TriangleUv(*scene.geometry, prim, hn::IfThenElse(in_first, a.b1, b.b1),
                 hn::IfThenElse(in_first, a.b2, b.b2));
  return PlacedAt(uv, q, triangle.n);
}

LANELIGHT_INLINE PlacedPoint PointOnSphere(const SceneParts& scene, const Lights& light,
                                           V3 q) {
  const V3 out = Normalize(q - LightSphere(scene, light.Primitive()).center);
  return PlacedAt(SphereUv(scene, light.Primitive(), out), q, out);
}

LANELIGHT_INLINE PlacedPoint PointOnDisk(const SceneParts& scene, const Lights& light,
                                         V3 q) {
  const LightDisk disk(scene, light.Primitive());
  return PlacedAt(DiskUv(scene, light.Primitive(), disk, q - disk.center), q, disk.n);
}

/// Multiplies the samples of one shape of light by factor(slots, light, point).
template <bool kMany, class PointOn, class Factor>
LANELIGHT_INLINE void MultiplyShape(Wave& wave, LightShape shape, const PointOn& point_on,
                                    const Factor& factor) {
  const PathColumns& p = wave.path;
  const SceneParts& scene = wave;
  ForEachLit<kMany>(wave, shape, [&](const StoreSlots& slots, VI index) HWY_ATTR {
    const Lights light(scene, index);
    const V3 q =
        MulAdd(Gather3(p.ls_x, p.ls_y, p.ls_z, slots), Gather(p.ls_distance, slots),
               Gather3(p.p_x, p.p_y, p.p_z, slots));
    const auto value = factor(slots, light, point_on(scene, light, q));
    const V3 radiance = Gather3(p.ls_r, p.ls_g, p.ls_b, slots);
    // A sample that is of no use may have no point.
    const MF used = hn::Gt(SumAbs(radiance), Splat(0));
    Scatter3(IfThenElseZero(used, Mul(radiance, value)), p.ls_r, p.ls_g, p.ls_b, slots);
  });
}

/// The same for all shapes that emit.
template <bool kMany, class Factor>
LANELIGHT_INLINE void MultiplySamples(Wave& wave, const Factor& factor) {
  const FeatureSet& features = wave.run->features;
  if (features.Has(Feature::kTriangleLights)) {
    MultiplyShape<kMany>(wave, LightShape::kTriangle, PointOnTriangle, factor);
  }
  if (features.Has(Feature::kRectangleLights)) {
    MultiplyShape<kMany>(wave, LightShape::kRectangle, PointOnRectangle, factor);
  }
  if (features.Has(Feature::kSphereLights)) {
    MultiplyShape<kMany>(wave, LightShape::kSphere, PointOnSphere, factor);
  }
  if (features.Has(Feature::kDiskLights)) {
    MultiplyShape<kMany>(wave, LightShape::kDisk, PointOnDisk, factor);
  }
}

LANELIGHT_END_KERNELS

#endif
