// Finds the randomisation of a sample, and the index of the sample in it.
#ifndef LANELIGHT_POINTS_GROUP_INL_H_
#define LANELIGHT_POINTS_GROUP_INL_H_

#include "kernels/simd/rng-inl.h"
#include "src/vocabulary/path/replicates.h"
#include "src/vocabulary/path/run_parameters.h"

LANELIGHT_BEGIN_KERNELS

/// A group of samples shares one randomisation; different groups, pixels, keys and seeds
/// are independent of each other.
struct GroupIndex {
  VU group, index;
};

/// The key of a point: pixel, group of its samples, dimension, seed.
struct PointKey {
  VU pixel;
  GroupIndex at;
  VU key, seed;
};

/// Samples take turns at kReplicates groups (src/vocabulary/path/replicates.h). A group
/// ends with the sampler's sequence, after 2^group_shift points; then as many new ones
/// begin.
LANELIGHT_INLINE GroupIndex GroupByTurns(const PointsParameters& points, VU sample) {
  constexpr int kLog = kLogReplicates;
  const int shift = static_cast<int>(points.group_shift);
  const VU turn = hn::ShiftRight<kLog>(sample);
  const VU round = hn::ShiftRightSame(turn, shift);
  const VU replicate = hn::And(sample, SplatU(kReplicates - 1));
  return {hn::Or(hn::ShiftLeft<kLog>(round), replicate),
          hn::Sub(turn, hn::ShiftLeftSame(round, shift))};
}

/// The two samples of pair k, which is observation k, draw unpaired numbers from the same
/// randomisation: sample 2 k + e with k = 4 t + r becomes 4 (2 t + e) + r.
LANELIGHT_INLINE VU UnpairedSample(VU sample) {
  const VU turn = hn::ShiftLeft<3>(hn::ShiftRight<3>(sample));
  const VU of_pair = hn::ShiftLeft<2>(hn::And(sample, SplatU(1)));
  const VU replicate = hn::And(hn::ShiftRight<1>(sample), SplatU(kReplicates - 1));
  return hn::Or(hn::Or(turn, of_pair), replicate);
}

LANELIGHT_END_KERNELS

#endif
