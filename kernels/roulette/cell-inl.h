// Brightness of paths, which the training passes of path values
// (src/scene/prepare/tables.h) and roulettes share.
#ifndef LANELIGHT_ROULETTE_CELL_INL_H_
#define LANELIGHT_ROULETTE_CELL_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/queue/grid_cell-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/prepare/tables.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the brightness, by the weights of the channels of the image.
LANELIGHT_INLINE VF Brightness(const PathValues& values, V3 c) {
  return hn::MulAdd(
      c.x, Splat(values.channel[0]),
      hn::MulAdd(c.y, Splat(values.channel[1]), hn::Mul(c.z, Splat(values.channel[2]))));
}

LANELIGHT_END_KERNELS

#endif
