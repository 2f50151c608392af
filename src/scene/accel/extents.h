// The extents of many items.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "src/scene/accel/partition.h"
#include "src/scene/accel/wide_box.h"

namespace lanelight {

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

/// The same by several threads if there are many.
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
