// The sign of a hit distance in double precision, for the rare rays that start within
// rounding error of a shape. Scalar code, shared by all SIMD targets.
#pragma once

namespace lanelight {

/// True if the plane of triangle (v0, v1, v2) lies ahead of `o` along `d` (t > 0).
inline bool PlaneIsAhead(const float o[3], const float d[3], const float v0[3],
                         const float v1[3], const float v2[3]) {
  double e1[3], e2[3], a[3];
  for (int i = 0; i < 3; ++i) {
    e1[i] = double{v1[i]} - v0[i];
    e2[i] = double{v2[i]} - v0[i];
    a[i] = double{v0[i]} - o[i];
  }
  const double n[3] = {e1[1] * e2[2] - e1[2] * e2[1], e1[2] * e2[0] - e1[0] * e2[2],
                       e1[0] * e2[1] - e1[1] * e2[0]};
  const double distance = n[0] * a[0] + n[1] * a[1] + n[2] * a[2];
  const double speed = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
  return (distance > 0 && speed > 0) || (distance < 0 && speed < 0);
}

}  // namespace lanelight
