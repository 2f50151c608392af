// Triangles and rectangles that emit, as one receiver sees them: solid angle, points by
// solid angle, and the warp by the cosine at the receiver (light-points=projected).
//   density     pdf_sa = b(u) / omega; b bilinear over the primary-sample square, in the
//               cosines at the corners of the light, but at least a tenth of the largest
//               among them and the one in the light's middle
//   floor       surfaces that transmit see light below the receiver: the floor keeps its
//               density above an eighth of that by solid angle alone, and its weights at
//               most 7.75 times as large (six times the error under a leaf that a window
//               crosses). Relative to the largest cosine it keeps the warp of grazing
//               lights; the middle's cosine serves lights that surround the receiver
//   below       a light wholly below the receiver's plane is not warped
//   source      Hart et al. 2020 (kernels/warp/solid_angle-inl.h)
#ifndef LANELIGHT_LIGHTS_FLAT_INL_H_
#define LANELIGHT_LIGHTS_FLAT_INL_H_

#include "kernels/lights/geometry-inl.h"
#include "kernels/warp/spherical_rectangle-inl.h"
#include "kernels/warp/spherical_triangle-inl.h"
#include "src/vocabulary/path/stage.h"
#include "src/vocabulary/strategy/choices.h"

LANELIGHT_BEGIN_KERNELS

/// Weights of the corners from their cosines; `middle`: the cosine there.
LANELIGHT_INLINE Bilinear FlooredCosines(const Bilinear& c, VF middle) {
  const VF first = hn::Max(hn::Max(c.w00, c.w10), hn::Max(c.w01, c.w11));
  const VF part = hn::Mul(Splat(0.1f), hn::Max(first, middle));
  const VF min_part = hn::Max(part, Splat(1e-6f));
  return {hn::Max(c.w00, min_part), hn::Max(c.w10, min_part), hn::Max(c.w01, min_part),
          hn::Max(c.w11, min_part)};
}

/// The common members of both shapes:
///   omega     solid angle
///   Weights   of the corners of the square, for a unit normal of the receiver
///   At        the point on the light for a point of the square
///   Square    the point of the square where a ray (columns of the hit) met the light
struct VisibleTriangle {
  static constexpr LightShape kShape = LightShape::kTriangle;
  const LightTriangle& triangle;
  V3 from;
  SphericalTriangle view;
  VF omega;

  LANELIGHT_INLINE VisibleTriangle(const LightTriangle& t, V3 receiver)
      : triangle(t), from(receiver), view(t.p0 - from, t.e1, t.e2) {
    omega = view.SolidAngle();
  }

  LANELIGHT_INLINE Bilinear Weights(V3 normal) const {
    const VF c0 = Dot(normal, view.v0), c1 = Dot(normal, view.v1);
    const VF c2 = Dot(normal, view.v2);
    const V3 sum = view.v0 + view.v1 + view.v2;
    const VF middle = hn::Mul(hn::Add(c0, hn::Add(c1, c2)), Rsqrt(Dot(sum, sum)));
    return FlooredCosines({c1, c1, c0, c2}, middle);
  }

  // Returns the intersection of the direction with the plane. Rounding at grazing angles
  // must not put the point farther away than the farthest corner.
  LANELIGHT_INLINE V3 At(UnitSquarePoint u) const {
    const V3 direction = SampleSphericalTriangle(view, omega, u.u0, u.u1);
    const V3 p0 = triangle.p0 - from;
    const V3 p1 = p0 + triangle.e1, p2 = p0 + triangle.e2;
    const VF far2 = hn::Max(Dot(p0, p0), hn::Max(Dot(p1, p1), Dot(p2, p2)));
    const VF distance = hn::Abs(hn::Div(Dot(p0, triangle.n), Dot(direction, triangle.n)));
    return MulAdd(direction, hn::Min(distance, hn::Sqrt(far2)), from);
  }

  LANELIGHT_INLINE UnitSquarePoint Square(const PathColumns& p,
                                          const Slots& slots) const {
    return InvertSphericalTriangle(triangle.p0 - from, triangle.e1, triangle.e2, omega,
                                   Gather(p.b1, slots), Gather(p.b2, slots));
  }
};

/// A rectangle as a light sample sees it, like VisibleTriangle.
struct VisibleRectangle {
  static constexpr LightShape kShape = LightShape::kRectangle;
  const LightRectangle& rectangle;
  V3 from;
  LocalRectangle view;
  VF omega;

  LANELIGHT_INLINE VisibleRectangle(const LightRectangle& r, V3 receiver)
      : rectangle(r), from(receiver), view(r.From(receiver)) {
    omega = view.SolidAngle(r.size_x, r.size_y);
  }

  LANELIGHT_INLINE Bilinear Weights(V3 normal) const {
    const LightRectangle& r = rectangle;
    // The view has the light above the receiver.
    const VF up = hn::CopySign(Splat(1.0f), Dot(r.corner - from, r.n));
    const V3 n = {Dot(normal, r.along_x), Dot(normal, r.along_y),
                  hn::Mul(Dot(normal, r.n), up)};
    const V3 v00 = view.Unit(view.x0, view.y0), v10 = view.Unit(view.x1, view.y0);
    const V3 v01 = view.Unit(view.x0, view.y1), v11 = view.Unit(view.x1, view.y1);
    const V3 sum = (v00 + v11) + (v10 + v01);
    const VF middle = hn::Mul(Dot(n, sum), Rsqrt(Dot(sum, sum)));
    const VF c10 = Dot(n, v10), c01 = Dot(n, v01);
    const MF swap = SwapsSides(view);
    return FlooredCosines({Dot(n, v00), hn::IfThenElse(swap, c01, c10),
                           hn::IfThenElse(swap, c10, c01), Dot(n, v11)},
                          middle);
  }

  LANELIGHT_INLINE V3 At(UnitSquarePoint u) const {
    const RectanglePoint at = SampleSphericalRectangle(view, omega, u.u0, u.u1);
    return rectangle.At(at.x, at.y);
  }

  LANELIGHT_INLINE UnitSquarePoint Square(const PathColumns& p,
                                          const Slots& slots) const {
    const V3 hit = Mul(Gather3(p.d_x, p.d_y, p.d_z, slots), HitDistance(p, slots));
    return InvertSphericalRectangle(view, omega,
                                    {hn::Sub(Dot(hit, rectangle.along_x), view.x0),
                                     hn::Sub(Dot(hit, rectangle.along_y), view.y0)});
  }
};

/// Returns kernel(points) for the LightPoints of a plan, an integral constant.
template <class Kernel>
StageFn ByLightPoints(const FeatureSet& features, Feature projected,
                      const Kernel& kernel) {
  using enum LightPoints;
  if (features.Has(projected)) {
    return kernel(std::integral_constant<LightPoints, kProjected>());
  }
  return features.Has(Feature::kSolidAngleLights)
             ? kernel(std::integral_constant<LightPoints, kSolidAngle>())
             : kernel(std::integral_constant<LightPoints, kArea>());
}

LANELIGHT_END_KERNELS

#endif
