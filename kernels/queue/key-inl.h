// Keys of random numbers (src/vocabulary/path/dimensions.h), for a batch of paths.
#ifndef LANELIGHT_QUEUE_KEY_INL_H_
#define LANELIGHT_QUEUE_KEY_INL_H_

#include "kernels/queue/slots-inl.h"
#include "src/vocabulary/path/dimensions.h"
#include "src/vocabulary/path/fields.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the key of dimension 0 at a depth.
HWY_INLINE VU FirstKey(VU depth) { return hn::ShiftLeft<kDepthShift>(depth); }

/// Returns the key of dimension 0 at a depth, for split paths too.
HWY_INLINE VU FirstKey(const PathColumns& p, VU depth, const Slots& slots) {
  if (p.branch == nullptr) return FirstKey(depth);
  const VU branch = hn::BitCast(DU(), Gather(p.branch, slots));
  return hn::Or(FirstKey(depth), hn::ShiftLeft<kBranchShift>(branch));
}

/// Returns the key of a dimension; `offset` lies within the range of its purpose.
HWY_INLINE VU KeyOf(const PathColumns& p, Dimension dimension, VU depth,
                    const Slots& slots, uint32_t offset = 0) {
  const uint32_t place = static_cast<uint32_t>(dimension) + offset;
  return hn::Add(FirstKey(p, depth, slots), hn::Set(DU(), place));
}

LANELIGHT_END_KERNELS

#endif
