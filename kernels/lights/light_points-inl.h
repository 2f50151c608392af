// Surface coordinates of points on emitting shapes.
#ifndef LANELIGHT_LIGHTS_LIGHT_POINTS_INL_H_
#define LANELIGHT_LIGHTS_LIGHT_POINTS_INL_H_

#include "kernels/lights/light_image-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Returns whether the lights of the lanes have this shape.
HWY_INLINE MF HasShape(const Lights& light, LightShape shape) {
  return hn::RebindMask(DF(), hn::Eq(light.I(offsetof(LightRecord, shape)),
                                     hn::Set(DI(), static_cast<int32_t>(shape))));
}

/// Returns the primitives of lights that have a shape, and `any` one of it elsewhere.
HWY_INLINE VI PrimitiveOf(const Lights& light, MF has_shape, uint32_t any) {
  return hn::IfThenElse(hn::RebindMask(DI(), has_shape), light.Primitive(),
                        hn::Set(DI(), static_cast<int32_t>(any)));
}

struct TriangleWeights {
  VF b1, b2;
};

/// Returns barycentric weights of the point of a triangle's plane that is nearest to q.
HWY_INLINE TriangleWeights WeightsOf(const LightTriangle& triangle, V3 q) {
  const V3 e1 = triangle.e1, e2 = triangle.e2, d = q - triangle.p0;
  const VF a = Dot(e1, e1), b = Dot(e1, e2), c = Dot(e2, e2);
  const VF along1 = Dot(d, e1), along2 = Dot(d, e2);
  const VF inverse = hn::Div(Splat(1.0f), DifferenceOfProducts(a, c, b, b));
  return {hn::Mul(DifferenceOfProducts(c, along1, b, along2), inverse),
          hn::Mul(DifferenceOfProducts(a, along2, b, along1), inverse)};
}

HWY_INLINE LightUv UvOnTriangle(const SceneParts& scene, const LightTriangle& triangle,
                                VI prim, V3 q) {
  const TriangleWeights w = WeightsOf(triangle, q);
  return TriangleUv(*scene.geometry, prim, w.b1, w.b2);
}

/// `triangle`: the first of the two.
HWY_INLINE LightUv UvOnRectangle(const SceneParts& scene, const LightTriangle& triangle,
                                 VI first, VI second, V3 q) {
  const TriangleWeights a = WeightsOf(triangle, q);
  const TriangleWeights b = WeightsOf(LightTriangle(scene, second), q);
  const auto minimum = [](const TriangleWeights& w) HWY_ATTR {
    const VF b0 = hn::Sub(hn::Sub(Splat(1.0f), w.b1), w.b2);
    return hn::Min(b0, hn::Min(w.b1, w.b2));
  };
  const MF in_first = hn::Ge(minimum(a), minimum(b));
  const VI prim = hn::IfThenElse(hn::RebindMask(DI(), in_first), first, second);
  return TriangleUv(*scene.geometry, prim, hn::IfThenElse(in_first, a.b1, b.b1),
                    hn::IfThenElse(in_first, a.b2, b.b2));
}

LANELIGHT_END_KERNELS

#endif
