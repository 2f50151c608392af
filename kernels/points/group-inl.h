// Which randomisation a sample belongs to, and its index in it.
#if defined(LANELIGHT_POINTS_GROUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_POINTS_GROUP_INL_H_
#undef LANELIGHT_POINTS_GROUP_INL_H_
#else
#define LANELIGHT_POINTS_GROUP_INL_H_
#endif

#include "kernels/simd/rng-inl.h"
#include "src/path/run_parameters.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// A group of samples shares one randomisation; different groups, pixels, keys and seeds
/// are independent of each other.
struct GroupIndex {
  VU group, index;
};

/// For samplers whose groups are powers of two.
LANELIGHT_INLINE GroupIndex GroupByShift(const PointsParameters& points, VU sample) {
  const int shift = static_cast<int>(points.group_shift);
  const VU group = hn::ShiftRightSame(sample, shift);
  return {group, hn::Sub(sample, hn::ShiftLeftSame(group, shift))};
}

/// For groups of any size; sample < 2^31. See PointsParameters::group_magic.
LANELIGHT_INLINE GroupIndex GroupByDivision(const PointsParameters& points, VU sample) {
  const DU du;
  const VU magic = SplatU(points.group_magic);
  const auto even = hn::MulEven(sample, magic);
  const hn::Repartition<uint64_t, DU> d64;
  const VU odd_lanes = hn::BitCast(du, hn::ShiftRight<32>(hn::BitCast(d64, sample)));
  const auto odd = hn::MulEven(odd_lanes, magic);
  const int shift = static_cast<int>(points.group_magic_shift);
  const auto q_even = hn::ShiftRightSame(even, shift);
  const auto q_odd = hn::ShiftLeft<32>(hn::ShiftRightSame(odd, shift));
  const VU group = hn::BitCast(du, hn::Or(q_even, q_odd));
  return {group, hn::Sub(sample, hn::Mul(group, SplatU(points.group_size)))};
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
