// The sign of a hit distance in double precision, for the rare rays that start within
// rounding error of a shape. Scalar code, shared by all SIMD targets.
#pragma once

namespace lanelight {

/// (v1 - v0) x (v2 - v0).
inline void ExactNormal(const float v0[3], const float v1[3], const float v2[3],
                        double n[3]) {
  double e1[3], e2[3];
  for (int i = 0; i < 3; ++i) {
    e1[i] = double{v1[i]} - v0[i];
    e2[i] = double{v2[i]} - v0[i];
  }
  n[0] = e1[1] * e2[2] - e1[2] * e2[1];
  n[1] = e1[2] * e2[0] - e1[0] * e2[2];
  n[2] = e1[0] * e2[1] - e1[1] * e2[0];
}

/// True if the plane through `v0` with normal n lies ahead of `o` along `d` (t > 0).
/// AheadOf in many-inl.h is its twin for many rays, with the same order of operations.
inline bool PlaneIsAhead(const float o[3], const float d[3], const double n[3],
                         const float v0[3]) {
  const double distance =
      (n[0] * (double{v0[0]} - o[0]) + n[1] * (double{v0[1]} - o[1])) +
      n[2] * (double{v0[2]} - o[2]);
  const double speed = (n[0] * d[0] + n[1] * d[1]) + n[2] * d[2];
  return (distance > 0 && speed > 0) || (distance < 0 && speed < 0);
}

}  // namespace lanelight
