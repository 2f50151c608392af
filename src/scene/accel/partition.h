// Sorts and measures many items with several threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "src/base/core/parallel.h"
#include "src/scene/accel/builder.h"

namespace lanelight {

/// Four numbers as one vector of the baseline target, the fourth unused.
typedef float Float4 __attribute__((vector_size(16)));

inline Float4 Min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 Largest(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 Load4(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}
// The box of an item: its floats lie one after another, and the id behind them.
static_assert(offsetof(AccelBox, hi) == 12 && offsetof(BuildItem, id) == 24);
inline Float4 LowOf(const BuildItem& item) { return Load4(&item.box.lo.x); }
inline Float4 HighOf(const BuildItem& item) { return Load4(&item.box.hi.x); }

struct WideBox {
  Float4 lo{INFINITY, INFINITY, INFINITY, INFINITY};
  Float4 hi{-INFINITY, -INFINITY, -INFINITY, -INFINITY};

  void Extend(Float4 l, Float4 h) {
    lo = Min(lo, l);
    hi = Largest(hi, h);
  }
  void Extend(Float4 p) { Extend(p, p); }
  void Extend(const WideBox& b) { Extend(b.lo, b.hi); }
  void Clip(Float4 l, Float4 h) {
    lo = Largest(lo, l);
    hi = Min(hi, h);
  }
  /// Half the surface area; 0 for an empty box.
  float HalfArea() const {
    const Float4 e = hi - lo;
    return e[0] >= 0 ? e[0] * e[1] + e[1] * e[2] + e[2] * e[0] : 0.0f;
  }
  bool IsEmpty() const { return hi[0] < lo[0] || hi[1] < lo[1] || hi[2] < lo[2]; }
  AccelBox Box() const { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }
};

/// Ranges of at least twice as many items are worked on in parts of this size by several
/// threads.
inline constexpr std::uint32_t kPart = 16384;

/// Moves the items for which `is_first` is true to the front; returns how many they are.
/// Which items stand on the wrong side is listed block by block from both ends without a
/// branch that depends on them, then they are exchanged (Edelkamp and Weiss 2016).
template <class IsFirst>
std::uint32_t PartitionPart(BuildItem* items, std::uint32_t count, IsFirst&& is_first) {
  constexpr std::uint32_t kBlock = 32;
  std::uint8_t low[kBlock], high[kBlock];  // places of such items in their blocks
  std::uint32_t num_low = 0, num_high = 0, at_low = 0, at_high = 0;
  std::uint32_t begin = 0, end = count;
  while (end - begin > 2 * kBlock) {
    if (num_low == 0) {
      at_low = 0;
      for (std::uint32_t i = 0; i < kBlock; ++i) {
        low[num_low] = static_cast<std::uint8_t>(i);
        num_low += !is_first(items[begin + i]);
      }
    }
    if (num_high == 0) {
      at_high = 0;
      for (std::uint32_t i = 0; i < kBlock; ++i) {
        high[num_high] = static_cast<std::uint8_t>(i);
        num_high += is_first(items[end - 1 - i]);
      }
    }
    const std::uint32_t n = std::min(num_low, num_high);
    for (std::uint32_t i = 0; i < n; ++i) {
      std::swap(items[begin + low[at_low + i]], items[end - 1 - high[at_high + i]]);
    }
    num_low -= n, at_low += n;
    num_high -= n, at_high += n;
    if (num_low == 0) begin += kBlock;
    if (num_high == 0) end -= kBlock;
  }
  const auto* middle = std::partition(items + begin, items + end, is_first);
  return static_cast<std::uint32_t>(middle - items);
}

/// The same by several threads, with a result that does not depend on their number: parts
/// by themselves, then what is left on the wrong side is exchanged.
template <class IsFirst>
std::uint32_t PartitionItems(BuildItem* items, std::uint32_t count, IsFirst&& is_first) {
  if (count < 2 * kPart) return PartitionPart(items, count, is_first);
  std::vector<std::uint32_t> firsts((count + kPart - 1) / kPart);
  const auto begin_of = [](std::size_t part) {
    return static_cast<std::uint32_t>(part) * kPart;
  };
  ParallelFor(firsts.size(), [&](std::size_t i) {
    const std::uint32_t begin = begin_of(i);
    firsts[i] = PartitionPart(items + begin, std::min(kPart, count - begin), is_first);
  });
  std::uint32_t middle = 0;
  for (const std::uint32_t n : firsts) middle += n;
  // Runs [begin, end) of items on the wrong side; both sides have as many.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> below, above;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    const std::uint32_t begin = begin_of(i), split = begin + firsts[i];
    const std::uint32_t end = std::min(count, begin + kPart);
    if (split < std::min(end, middle)) below.emplace_back(split, std::min(end, middle));
    const std::uint32_t from = std::max(begin, middle);
    if (from < split) above.emplace_back(from, split);
  }
  for (std::size_t l = 0, r = 0; l < below.size();) {
    auto& [a, a_end] = below[l];
    auto& [b, b_end] = above[r];
    const std::uint32_t n = std::min(a_end - a, b_end - b);
    std::swap_ranges(items + a, items + a + n, items + b);
    a += n;
    b += n;
    l += a == a_end;
    r += b == b_end;
  }
  return middle;
}

/// The box of some items, and that of twice their centres.
struct Extents {
  WideBox all, middles;

  void Extend(const Extents& e) {
    all.Extend(e.all);
    middles.Extend(e.middles);
  }
};

inline Extents ExtentsOf(const BuildItem* items, std::uint32_t count) {
  Extents e;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Float4 lo = LowOf(items[i]), hi = HighOf(items[i]);
    e.all.Extend(lo, hi);
    e.middles.Extend(lo + hi);
  }
  return e;
}

inline void MeasureItems(const BuildItem* items, std::uint32_t count, AccelBox& box,
                         AccelBox& centers) {
  Extents e;
  if (count < 2 * kPart) {
    e = ExtentsOf(items, count);
  } else {
    std::vector<Extents> parts((count + kPart - 1) / kPart);
    ParallelFor(parts.size(), [&](std::size_t i) {
      const std::uint32_t begin = static_cast<std::uint32_t>(i) * kPart;
      parts[i] = ExtentsOf(items + begin, std::min(kPart, count - begin));
    });
    for (const Extents& part : parts) e.Extend(part);
  }
  box = e.all.Box();
  centers = e.middles.Box();
}

}  // namespace lanelight
