// Decides whether a path may scatter once more.
#ifndef LANELIGHT_QUEUE_DEPTH_INL_H_
#define LANELIGHT_QUEUE_DEPTH_INL_H_

#include <cstddef>

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/records-inl.h"
#include "src/scene/compiled/media.h"

LANELIGHT_BEGIN_KERNELS

/// Maximum number of uncounted events inside of materials. It ends paths that are neither
/// absorbed nor able to leave.
inline constexpr int32_t kMaxUncountedEvents = 1 << 16;

/// Returns the paths whose next event is inside of a material, or on its bounds from
/// within, and does not count towards the maximum depth; only with kSubsurface.
LANELIGHT_INLINE MF WalksInside(const Wave& wave, const Slots& slots) {
  const DI di;
  const VI medium = Gather(wave.path.medium, slots), vacuum = hn::Set(di, kVacuum);
  const RecordWords records(wave.media->media.data(), hn::Max(medium, hn::Zero(di)));
  const auto in_medium = hn::RebindMask(DF(), hn::Gt(medium, vacuum));
  const VI walked = Gather(wave.path.walked, slots);
  const auto few = hn::RebindMask(DF(), hn::Lt(walked, hn::Set(di, kMaxUncountedEvents)));
  return hn::And(hn::And(in_medium, few), records.IsSet(offsetof(MediumRecord, inside)));
}

/// Returns the paths that may scatter once more.
LANELIGHT_INLINE MF MayScatter(const Wave& wave, const Slots& slots) {
  const VI max_depth = hn::Set(DI(), static_cast<int32_t>(wave.run->max_depth));
  const VI depth = Gather(wave.path.depth, slots);
  if (wave.path.walked == nullptr) return hn::RebindMask(DF(), hn::Lt(depth, max_depth));
  const VI counted = hn::Sub(depth, Gather(wave.path.walked, slots));
  const MF below = hn::RebindMask(DF(), hn::Lt(counted, max_depth));
  return hn::Or(below, WalksInside(wave, slots));
}

LANELIGHT_END_KERNELS

#endif
