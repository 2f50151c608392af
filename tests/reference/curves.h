// Curves of the reference tracer: cubic Bezier curves in world space, cut in halves until
// a piece has one place that is nearest to the ray at most, which is then bisected.
#pragma once

#include "tests/reference/geometry.h"

namespace lanelight::reference {

/// The curve in the world; widths under a transform that keeps shapes.
Curve CurveInWorld(const Curve& curve, const Transform& world_from_object,
                   double normal_sign);

/// The nearest hit: 1 and its distance, with b1 = place along the curve; or 0.
int IntersectCurve(const Curve& curve, const Ray& ray, Hit& nearest);

SurfacePoint DescribeCurve(const Curve& curve, const Ray& ray, const Hit& hit);

}  // namespace lanelight::reference
