// The lane types of all kernels, and tables reached by lane.
#ifndef LANELIGHT_SIMD_LANES_INL_H_
#define LANELIGHT_SIMD_LANES_INL_H_

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hwy/highway.h"

// Routines that everything is made of. Where a vector is a register, a call would cost
// more than they do; in the emulation they are long, and the compiler's time is what
// counts.
#undef LANELIGHT_INLINE
#if HWY_TARGET == HWY_EMU128
#define LANELIGHT_INLINE inline HWY_NOINLINE
#else
#define LANELIGHT_INLINE HWY_INLINE
#endif

LANELIGHT_BEGIN_KERNELS
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using MF = hn::Mask<DF>;

// Tables, by lane index.
LANELIGHT_INLINE VF Gather(const float* base, VI index) {
  return hn::GatherIndex(DF(), base, index);
}
LANELIGHT_INLINE VI Gather(const int32_t* base, VI index) {
  return hn::GatherIndex(DI(), base, index);
}
LANELIGHT_INLINE VI Gather(const uint32_t* base, VI index) {
  return hn::GatherIndex(DI(), reinterpret_cast<const int32_t*>(base), index);
}
LANELIGHT_INLINE void Scatter(VF v, float* base, VI index) {
  hn::ScatterIndex(v, DF(), base, index);
}
LANELIGHT_INLINE void Scatter(VI v, int32_t* base, VI index) {
  hn::ScatterIndex(v, DI(), base, index);
}
LANELIGHT_INLINE void Scatter(VI v, uint32_t* base, VI index) {
  hn::ScatterIndex(v, DI(), reinterpret_cast<int32_t*>(base), index);
}

/// Permutations are faster than gathers of many lanes.
inline constexpr bool kWindows = hn::MaxLanes(DF()) >= 8;

/// Entries of a table of `count`, index < count: a small one fits into a register.
LANELIGHT_INLINE VF Lookup(const float* table, std::size_t count, VI index) {
  const DF df;
  if (kWindows && count <= hn::Lanes(df)) {
    const VF all = hn::MaskedLoad(hn::FirstN(df, count), df, table);
    return hn::TableLookupLanes(all, hn::IndicesFromVec(df, index));
  }
  return hn::GatherIndex(df, table, index);
}
template <class Column>
HWY_INLINE auto Lookup(const Column& table, VI index) {
  const auto* entries = table.data();
  const VF found = Lookup(reinterpret_cast<const float*>(entries), table.size(), index);
  if constexpr (std::is_same_v<decltype(entries), const float*>) {
    return found;
  } else {
    return hn::BitCast(DI(), found);
  }
}

/// Returns fn(double tag, v...), computed in double precision half a vector at a time and
/// rounded to float once.
template <class D, class Fn, class... V>
LANELIGHT_INLINE hn::Vec<D> InDouble(D d, Fn&& fn, V... v) {
  const hn::Half<D> dh;
  const hn::Rebind<double, hn::Half<D>> dd;
  const auto upper = fn(dd, hn::PromoteTo(dd, hn::UpperHalf(dh, v))...);
  const auto lower = fn(dd, hn::PromoteTo(dd, hn::LowerHalf(dh, v))...);
  return hn::Combine(d, hn::DemoteTo(dh, upper), hn::DemoteTo(dh, lower));
}

LANELIGHT_END_KERNELS

#endif
