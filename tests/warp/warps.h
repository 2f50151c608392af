// What the kernels and the checks of warp_test.cc share.
#pragma once

namespace lanelight {

enum class WarpId { kDisk, kCosine, kUniformHemisphere, kInSphere };

struct WarpBatch {
  int n;
  const float *u0, *u1;
  float *x, *y, *z, *pdf, *back0, *back1;
};

}  // namespace lanelight
