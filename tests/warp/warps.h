// What the kernels and the checks of warp_test.cc share.
#pragma once

namespace lanelight {

enum class WarpId {
  kDisk,
  kCosine,
  kUniformHemisphere,
  kInSphere,
  kSphere,
  kCone,
  kTriangle
};
inline constexpr float kConeRise = 1e-3f;
struct WarpBatch {
  int n;
  const float *u0, *u1;
  float *x, *y, *z, *pdf, *back0, *back1;
};

}  // namespace lanelight
