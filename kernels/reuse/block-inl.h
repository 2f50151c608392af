// Records of a task (src/vocabulary/path/block.h), by lane.
#ifndef LANELIGHT_REUSE_BLOCK_INL_H_
#define LANELIGHT_REUSE_BLOCK_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/vocabulary/path/sent.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE VI StateLanes(ReuseState state) {
  return hn::Set(DI(), static_cast<int32_t>(state));
}

/// Of samples, by their place in the task's buffer, where those of a pixel are
/// neighbours; in records those of a block are. Exact below 2^21 samples.
HWY_INLINE VI RecordOf(const TileWork& work, VI output) {
  const DI di;
  const VI samples = hn::Set(di, static_cast<int32_t>(work.samples));
  const VF middle = hn::Add(hn::ConvertTo(DF(), output), Splat(0.5f));
  const VF per_pixel = Splat(1.0f / static_cast<float>(work.samples));
  const VI place = hn::ConvertTo(di, hn::Mul(middle, per_pixel));  // towards 0
  const VI sample = hn::Sub(output, hn::Mul(place, samples));
  return hn::Add(hn::Mul(sample, hn::Set(di, static_cast<int32_t>(work.num_pixels))),
                 place);
}

LANELIGHT_END_KERNELS

#endif
