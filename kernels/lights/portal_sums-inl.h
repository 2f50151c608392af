// Sums of the weights of an environment's texels over windows of it, which move with the
// point that looks through the portal: from the summed-area table of the map (Crow 1984),
// bilinear within texels, in double precision as small differences of large sums.
#ifndef LANELIGHT_LIGHTS_PORTAL_SUMS_INL_H_
#define LANELIGHT_LIGHTS_PORTAL_SUMS_INL_H_

#include "kernels/surface/point-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

/// Half a vector of windows, in texels, and the sums of weights inside them.
class PortalSums {
 public:
  LANELIGHT_INLINE PortalSums(const Portal& portal, VD x0, VD x1, VD y0, VD y1)
      : sums_(portal.sums.data()),
        size_(hn::Set(DD(), portal.size)),
        x0_(x0),
        x1_(x1),
        y0_(y0),
        y1_(y1),
        low_(Below(x0, y0)),
        high_(Below(x0, y1)),
        total_(Left(x1)) {}

  struct Point {
    VD x, y;
    VD column, row;  // of its texel
    VD density;      // over the square
  };

  HWY_NOINLINE Point Sample(VD u0, VD u1) const {
    Point at;
    at.x = SampleColumn(u0, &at.column);
    at.y = SampleRow(u1, at.column, &at.row);
    at.density = Density(at.column, at.row);
    return at;
  }

  /// Returns the density of a point of the window with this texel; 0 if the window is
  /// black.
  LANELIGHT_INLINE VD Density(VD column, VD row) const {
    const VD one = hn::Set(DD(), 1.0), zero = hn::Zero(DD());
    const VD mine = Between(column, hn::Add(column, one), row, hn::Add(row, one));
    const VD density = hn::Div(hn::Mul(mine, hn::Mul(size_, size_)), total_);
    const auto some = hn::And(hn::Gt(mine, zero), hn::Gt(total_, zero));
    return hn::IfThenElseZero(some, density);
  }

 private:
  LANELIGHT_INLINE VD Node(VD column, VD row) const {
    // Converts by way of 32 bits: AVX2 cannot convert doubles to 64.
    const hn::RebindToSigned<DD> di;
    const hn::Rebind<int32_t, DD> narrow;
    const VD at = hn::MulAdd(row, hn::Add(size_, hn::Set(DD(), 1.0)), column);
    const auto index = hn::PromoteTo(di, hn::DemoteTo(narrow, at));
    return hn::GatherIndex(DD(), sums_, index);
  }
  // A coordinate in [0, size]: texels before it, and its part of the next.
  struct Split {
    VD texel, part;
  };
  LANELIGHT_INLINE Split SplitOf(VD v) const {
    const VD texel = hn::Min(hn::Floor(v), hn::Sub(size_, hn::Set(DD(), 1.0)));
    return {texel, hn::Sub(v, texel)};
  }
  LANELIGHT_INLINE static VD Mix(VD a, VD b, VD t) {
    return hn::MulAdd(hn::Sub(b, a), t, a);
  }
  // Below() for x, or y, that are texels before the last, where its mixtures have no
  // part.
  LANELIGHT_INLINE VD BelowAtColumn(VD column, const Split& y) const {
    const VD next = hn::Add(y.texel, hn::Set(DD(), 1.0));
    return Mix(Node(column, y.texel), Node(column, next), y.part);
  }
  LANELIGHT_INLINE VD BelowAtRow(const Split& x, VD row) const {
    const VD next = hn::Add(x.texel, hn::Set(DD(), 1.0));
    return Mix(Node(x.texel, row), Node(next, row), x.part);
  }
  // Returns the sum to the left of x and below y, both in [0, size].
  LANELIGHT_INLINE VD Below(VD x, VD y) const {
    const Split split = SplitOf(x), rows = SplitOf(y);
    const VD next = hn::Add(rows.texel, hn::Set(DD(), 1.0));
    return Mix(BelowAtRow(split, rows.texel), BelowAtRow(split, next), rows.part);
  }
  HWY_NOINLINE VD Between(VD left, VD right, VD low, VD high) const {
    return hn::Sub(hn::Sub(Below(right, high), Below(left, high)),
                   hn::Sub(Below(right, low), Below(left, low)));
  }
  // Returns the sum over the window to the left of x.
  LANELIGHT_INLINE VD Left(VD x) const {
    return hn::Sub(hn::Sub(Below(x, y1_), high_), hn::Sub(Below(x, y0_), low_));
  }

  HWY_NOINLINE VD SampleColumn(VD u, VD* column) const {
    const Split low = SplitOf(y0_), high = SplitOf(y1_);
    const auto to_texel = [&](VD x) HWY_ATTR {
      return hn::Sub(hn::Sub(BelowAtColumn(x, high), high_),
                     hn::Sub(BelowAtColumn(x, low), low_));
    };
    const VD wanted = hn::Mul(u, total_);
    *column = LastBelow(x0_, x1_, wanted, to_texel);
    return Within(x0_, x1_, wanted, *column, [&](VD x) HWY_ATTR { return Left(x); });
  }
  HWY_NOINLINE VD SampleRow(VD u, VD column, VD* row) const {
    const VD next = hn::Add(column, hn::Set(DD(), 1.0));
    const Split end = SplitOf(next);
    const VD before = hn::Sub(Below(next, y0_), Below(column, y0_));
    const auto to_texel = [&](VD y) HWY_ATTR {
      return hn::Sub(hn::Sub(BelowAtRow(end, y), Node(column, y)), before);
    };
    const auto to = [&](VD y) HWY_ATTR {
      return hn::Sub(hn::Sub(Below(next, y), Below(column, y)), before);
    };
    const VD wanted = hn::Mul(u, to(y1_));
    *row = LastBelow(y0_, y1_, wanted, to_texel);
    return Within(y0_, y1_, wanted, *row, to);
  }

  // The last texel between low and high up to which a sum does not exceed `wanted`. Most
  // of the time goes here: `sum` is that of whole texels.
  template <class Sum>
  LANELIGHT_INLINE VD LastBelow(VD low, VD high, VD wanted, const Sum& sum) const {
    const VD one = hn::Set(DD(), 1.0), half = hn::Set(DD(), 0.5);
    VD a = SplitOf(low).texel;
    VD b = hn::Max(hn::Ceil(high), hn::Add(a, one));
    for (;;) {
      const auto open = hn::Gt(hn::Sub(b, a), one);
      if (hn::AllFalse(DD(), open)) return a;
      const VD middle = hn::Floor(hn::Mul(hn::Add(a, b), half));
      const auto right = hn::Le(sum(middle), wanted);
      a = hn::IfThenElse(hn::And(open, right), middle, a);
      b = hn::IfThenElse(hn::AndNot(right, open), middle, b);
    }
  }
  // Returns the position in the texel at which a linearly growing sum reaches `wanted`.
  template <class Sum>
  LANELIGHT_INLINE VD Within(VD low, VD high, VD wanted, VD texel, const Sum& sum) const {
    const VD one = hn::Set(DD(), 1.0), half = hn::Set(DD(), 0.5);
    const VD first = hn::Max(texel, low), last = hn::Min(hn::Add(texel, one), high);
    const VD at_first = sum(first), width = hn::Sub(sum(last), at_first);
    const auto rises = hn::Gt(width, hn::Zero(DD()));
    const VD fraction =
        hn::IfThenElse(rises, hn::Div(hn::Sub(wanted, at_first), width), half);
    const VD inside = hn::Min(hn::Max(fraction, hn::Zero(DD())), one);
    return hn::MulAdd(hn::Sub(last, first), inside, first);
  }

  const double* sums_;
  VD size_, x0_, x1_, y0_, y1_;
  VD low_, high_, total_;  // Below() of the left corners, and of all of the window
};

LANELIGHT_END_KERNELS

#endif
