// Curves of the reference tracer: cubic Bezier curves in the space of their object, cut
// in halves until a piece has one place that is nearest to the ray at most, which is then
// bisected.
#pragma once

#include "tests/reference/geometry.h"

namespace lanelight::reference {

/// The nearest hit: 1 and its distance, with b1 = place along the curve; or 0. All in the
/// space of the object, with a unit direction.
int IntersectCurve(const Curve& curve, const Ray& ray, Hit& nearest);

SurfacePoint DescribeCurve(const Curve& curve, const Ray& ray, const Hit& hit);

/// The same in the world, for a primitive with a curve.
int IntersectPlacedCurve(const Primitive& primitive, const Ray& ray, Hit& nearest);
SurfacePoint DescribePlacedCurve(const Primitive& primitive, const Ray& ray, Hit hit);

}  // namespace lanelight::reference
