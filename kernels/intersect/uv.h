// Surface coordinates and normals of a hit on a sphere, disk or plane, in scalar double
// precision: what alpha cut-outs need. The conventions are pbrt-v4's; kernels/surface/
// has the vectorised twins.
#pragma once

#include <cmath>
#include <numbers>

#include "src/scene/geometry/geometry.h"

namespace lanelight {

struct SurfaceUv {
  float u = 0, v = 0;
};

inline double DotWith(const float a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Angle around the axis as a fraction of the circle, in [0, 1].
inline float TurnFraction(double y, double x) {
  const double phi = std::atan2(y, x);
  return static_cast<float>((phi < 0 ? phi + 2 * std::numbers::pi : phi) /
                            (2 * std::numbers::pi));
}

/// cross(a, b) . p
inline double CrossDot(const float a[3], const float b[3], const double p[3]) {
  return (double{a[1]} * b[2] - double{a[2]} * b[1]) * p[0] +
         (double{a[2]} * b[0] - double{a[0]} * b[2]) * p[1] +
         (double{a[0]} * b[1] - double{a[1]} * b[0]) * p[2];
}

/// Returns the coordinates where the normal of a sphere is `n`, of any length.
template <class Sphere>
SurfaceUv SphereUv(const Sphere& s, const double n[3]) {
  const double x = DotWith(s.x_axis, n), z = DotWith(s.z_axis, n);
  const double y = s.y_sign * CrossDot(s.z_axis, s.x_axis, n);
  const double theta = std::atan2(std::hypot(x, y), z);
  return {TurnFraction(y, x), static_cast<float>(1 - theta / std::numbers::pi)};
}

/// `p` relative to the centre.
inline SurfaceUv UvOf(const SphereRecord& s, const double p[3]) { return SphereUv(s, p); }

/// `p` relative to the point.
inline SurfaceUv UvOf(const LargeSphereRecord& s, const double p[3]) {
  double n[3];
  for (int i = 0; i < 3; ++i) n[i] = s.normal[i] + s.curvature * p[i];
  return SphereUv(s, n);
}

/// `p` relative to the centre.
inline SurfaceUv UvOf(const DiskRecord& s, const double p[3]) {
  const double x = DotWith(s.u_axis, p);
  const double y = s.v_sign * CrossDot(s.normal, s.u_axis, p);
  const double width = double{s.radius} - s.inner_radius;
  return {TurnFraction(y, x),
          static_cast<float>(width > 0 ? (s.radius - std::hypot(x, y)) / width : 0)};
}

/// `p` relative to the point.
inline SurfaceUv UvOf(const PlaneRecord& s, const double p[3]) {
  return {static_cast<float>(DotWith(s.u_axis, p)),
          static_cast<float>(DotWith(s.v_axis, p))};
}

/// Unit normals at the same points, of either side.
inline void NormalOf(const SphereRecord&, const double p[3], float n[3]) {
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (int i = 0; i < 3; ++i) n[i] = static_cast<float>(p[i] / length);
}
inline void NormalOf(const LargeSphereRecord& s, const double p[3], float n[3]) {
  double out[3];
  for (int i = 0; i < 3; ++i) out[i] = s.normal[i] + s.curvature * p[i];
  NormalOf(SphereRecord{}, out, n);
}
inline void NormalOf(const DiskRecord& s, const double*, float n[3]) {
  for (int i = 0; i < 3; ++i) n[i] = s.normal[i];
}
inline void NormalOf(const PlaneRecord& s, const double*, float n[3]) {
  for (int i = 0; i < 3; ++i) n[i] = s.normal[i];
}

}  // namespace lanelight
