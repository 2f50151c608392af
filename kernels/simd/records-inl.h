// Fixed-size records, one per lane: word by word, or four words at a time and a
// transposition, which costs about a third of four gathers.
#ifndef LANELIGHT_SIMD_RECORDS_INL_H_
#define LANELIGHT_SIMD_RECORDS_INL_H_

#include <bit>
#include <cstddef>

#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

/// A few words of one record per lane, by their offsets in the record.
template <class Record>
struct RecordWords {
  const float* words;
  VI at;

  /// 0 <= index, below 2^31 words.
  LANELIGHT_INLINE RecordWords(const Record* records, VI index)
      : words(reinterpret_cast<const float*>(records)) {
    constexpr std::size_t kWords = sizeof(Record) / 4;
    if constexpr (std::has_single_bit(kWords)) {
      at = hn::ShiftLeft<std::countr_zero(kWords)>(index);
    } else {
      at = hn::Mul(index, hn::Set(DI(), static_cast<int32_t>(kWords)));
    }
  }
  LANELIGHT_INLINE VF F(std::size_t byte_offset) const {
    return Gather(words + byte_offset / 4, at);
  }
  LANELIGHT_INLINE VI I(std::size_t byte_offset) const {
    return Gather(reinterpret_cast<const int32_t*>(words) + byte_offset / 4, at);
  }
  LANELIGHT_INLINE V3 F3(std::size_t byte_offset) const {
    return {F(byte_offset), F(byte_offset + 4), F(byte_offset + 8)};
  }
  LANELIGHT_INLINE MF IsSet(std::size_t byte_offset) const {
    return hn::RebindMask(DF(), hn::Ne(I(byte_offset), hn::Zero(DI())));
  }
};

/// The records of a vector of lanes, of which most words are needed.
class Records {
 public:
  /// Record i of the array `records` has `stride` words; 0 <= index, and index * stride
  /// below 2^31.
  HWY_INLINE Records(const void* records, int32_t stride, VI index)
      : base_(static_cast<const float*>(records)) {
    const DI di;
    hn::Store(hn::Mul(index, hn::Set(di, stride)), di, at_);
  }

  /// Words first .. first+3 of each record.
  HWY_INLINE void Load4(int first, VF out[4]) const {
    const DF df;
    const hn::Repartition<uint64_t, DF> d64;
    const VF r0 = Rows(df, first, 0), r1 = Rows(df, first, 1);
    const VF r2 = Rows(df, first, 2), r3 = Rows(df, first, 3);
    const auto low01 = hn::BitCast(d64, hn::InterleaveLower(df, r0, r1));
    const auto low23 = hn::BitCast(d64, hn::InterleaveLower(df, r2, r3));
    const auto high01 = hn::BitCast(d64, hn::InterleaveUpper(df, r0, r1));
    const auto high23 = hn::BitCast(d64, hn::InterleaveUpper(df, r2, r3));
    out[0] = hn::BitCast(df, hn::InterleaveLower(d64, low01, low23));
    out[1] = hn::BitCast(df, hn::InterleaveUpper(d64, low01, low23));
    out[2] = hn::BitCast(df, hn::InterleaveLower(d64, high01, high23));
    out[3] = hn::BitCast(df, hn::InterleaveUpper(d64, high01, high23));
  }

 private:
  // Four words of the lanes lane, lane + 4, lane + 8, ...
  template <class D>
  HWY_INLINE hn::Vec<D> Rows(D d, int first, int lane) const {
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
    if constexpr (kLanes == 4) {
      return hn::LoadU(d, base_ + at_[lane] + first);
    } else {
      const hn::Half<D> half;
      return hn::Combine(d, Rows(half, first, lane + kLanes / 2),
                         Rows(half, first, lane));
    }
  }

  const float* base_;
  HWY_ALIGN int32_t at_[hn::MaxLanes(DI())];
};

LANELIGHT_END_KERNELS

#endif
