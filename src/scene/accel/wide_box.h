// Boxes as vectors, which is how the builder grows them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

#include "src/scene/accel/builder.h"

namespace lanelight {

/// Four numbers as one vector of the baseline target, the fourth unused.
typedef float Float4 __attribute__((vector_size(16)));

inline Float4 Least(Float4 a, Float4 b) { return a < b ? a : b; }
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
    lo = Least(lo, l);
    hi = Largest(hi, h);
  }
  void Extend(Float4 p) { Extend(p, p); }
  void Extend(const WideBox& b) { Extend(b.lo, b.hi); }
  void Clip(Float4 l, Float4 h) {
    lo = Largest(lo, l);
    hi = Least(hi, h);
  }
  /// Half the surface area; 0 for an empty box.
  float HalfArea() const {
    const Float4 e = hi - lo;
    return e[0] >= 0 ? e[0] * e[1] + e[1] * e[2] + e[2] * e[0] : 0.0f;
  }
  bool IsEmpty() const { return hi[0] < lo[0] || hi[1] < lo[1] || hi[2] < lo[2]; }
  AccelBox Box() const { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }
};

}  // namespace lanelight
