// Bilinear functions of measured reflectance (src/scene/compiled/materials.h). Also the
// maps of the unit square to itself that invert their integrals, linear between the
// slices around a known direction.
#ifndef LANELIGHT_BSDF_MEASURED_TABLES_INL_H_
#define LANELIGHT_BSDF_MEASURED_TABLES_INL_H_

#include "kernels/simd/math-inl.h"
#include "kernels/simd/records-inl.h"
#include "src/scene/compiled/materials.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE VF Lerp(VF t, VF a, VF b) { return hn::MulAdd(t, hn::Sub(b, a), a); }

/// The last i in [0, count - 2] for which value(i) <= x, or 0; value does not decrease.
template <class Value>
LANELIGHT_INLINE VI LastBelow(VI count, VF x, const Value& value) {
  const DI di;
  const VI one = hn::Set(di, 1);
  VI low = hn::Zero(di), high = hn::Sub(count, one);
  while (!hn::AllFalse(di, hn::Gt(hn::Sub(high, low), one))) {
    const VI middle = hn::ShiftRight<1>(hn::Add(low, high));
    const auto below = hn::RebindMask(di, hn::Le(value(middle), x));
    low = hn::IfThenElse(below, middle, low);
    high = hn::IfThenElse(below, high, middle);
  }
  return low;
}

/// The slices around a known direction, with the share that each has.
struct MeasuredSlices {
  VI at[4];
  VF fraction[4];
  int count;  // used entries: 4 if azimuths matter, else 2
};

/// The nodes around x, first in [0, count - 1], and the share of the next one.
struct MeasuredNodes {
  VI first, next;
  VF fraction;

  LANELIGHT_INLINE MeasuredNodes(const float* nodes, VI at, VI count, VF x) {
    const VI one = hn::Set(DI(), 1);
    first =
        LastBelow(count, x, [&](VI i) HWY_ATTR { return Gather(nodes, hn::Add(at, i)); });
    next = hn::Min(hn::Add(first, one), hn::Sub(count, one));
    const VF low = Gather(nodes, hn::Add(at, first));
    const VF size = hn::Sub(Gather(nodes, hn::Add(at, next)), low);
    const VF part = hn::Div(hn::Sub(x, low), size);
    fraction = hn::IfThenElseZero(hn::Gt(size, hn::Zero(DF())),
                                  hn::Clamp(part, hn::Zero(DF()), Splat(1.0f)));
  }
};

/// A function of a point of the unit square, whose fields begin at `offset` of the
/// record.
struct MeasuredFunction {
  const float* values;
  const MeasuredSlices& slices;
  VI at, width, height;

  LANELIGHT_INLINE MeasuredFunction(const MeasuredTable& table,
                                    const RecordWords<MeasuredRecord>& record,
                                    const MeasuredSlices& s, std::size_t offset)
      : values(table.values.data()),
        slices(s),
        at(record.I(offset)),
        width(record.I(offset + 4)),
        height(record.I(offset + 8)) {}

  /// A point in a cell: the index of the cell's first number, and the coordinates (x, y)
  /// in it.
  struct Place {
    VI cell, row;
    VF x, y;
  };
  LANELIGHT_INLINE Place PlaceOf(VF x, VF y) const {
    const DI di;
    const auto split = [&](VF u, VI size, VI& cell) HWY_ATTR {
      const VF scaled = hn::Mul(u, hn::ConvertTo(DF(), hn::Sub(size, hn::Set(di, 1))));
      const VI maximum = hn::Sub(size, hn::Set(di, 2));
      cell = hn::Clamp(hn::ConvertTo(di, scaled), hn::Zero(di), maximum);
      return hn::Sub(scaled, hn::ConvertTo(DF(), cell));
    };
    Place place;
    VI column;
    place.x = split(x, width, column);
    place.y = split(y, height, place.row);
    place.cell = hn::Add(hn::Mul(place.row, width), column);
    return place;
  }
  LANELIGHT_INLINE VF Between(VI first, VI column, const Place& p) const {
    const VI low = hn::Add(first, column), high = hn::Add(low, width);
    const VI one = hn::Set(DI(), 1);
    const VF below = Lerp(p.x, Gather(values, low), Gather(values, hn::Add(low, one)));
    const VF above = Lerp(p.x, Gather(values, high), Gather(values, hn::Add(high, one)));
    return Lerp(p.y, below, above);
  }
  /// Returns the value of a function with one slice.
  LANELIGHT_INLINE VF Single(VF x, VF y) const {
    const Place p = PlaceOf(x, y);
    return Between(at, p.cell, p);
  }
  /// Returns the value of a function with three slices per direction.
  LANELIGHT_INLINE V3 Color(VF x, VF y) const {
    const Place p = PlaceOf(x, y);
    const VI size = hn::Mul(width, height), three = hn::Set(DI(), 3);
    V3 sum = Splat3(0, 0, 0);
    for (int i = 0; i < slices.count; ++i) {
      const VI r = hn::Add(at, hn::Mul(hn::Mul(slices.at[i], three), size));
      const VI g = hn::Add(r, size), b = hn::Add(g, size);
      const V3 color = {Between(r, p.cell, p), Between(g, p.cell, p),
                        Between(b, p.cell, p)};
      sum = MulAdd(color, slices.fraction[i], sum);
    }
    return sum;
  }
  /// Returns the values of a function with `count` slices per direction, at three places
  /// between the slices, in [0, count - 1].
  LANELIGHT_INLINE V3 Between(VF x, VF y, VI count, V3 at_slices) const {
    const Place p = PlaceOf(x, y);
    const VI size = hn::Mul(width, height), one = hn::Set(DI(), 1);
    const VI last = hn::Sub(count, one);
    const auto value = [&](VF place) HWY_ATTR {
      const VI low = hn::ConvertTo(DI(), place), high = hn::Min(hn::Add(low, one), last);
      const VF part = hn::Sub(place, hn::ConvertTo(DF(), low));
      VF sum = hn::Zero(DF());
      for (int i = 0; i < slices.count; ++i) {
        const VI first = hn::Mul(slices.at[i], count);
        const auto of = [&](VI slice) HWY_ATTR {
          const VI begin = hn::Add(hn::Mul(hn::Add(first, slice), size), at);
          return Between(begin, p.cell, p);
        };
        sum = hn::MulAdd(Lerp(part, of(low), of(high)), slices.fraction[i], sum);
      }
      return sum;
    };
    return {value(at_slices.x), value(at_slices.y), value(at_slices.z)};
  }
};

/// Maps uniform points of (0, 1)^2 to points with a density over the unit square.
struct MeasuredMap : MeasuredFunction {
  VI along, before;

  LANELIGHT_INLINE MeasuredMap(const MeasuredTable& table,
                               const RecordWords<MeasuredRecord>& record,
                               const MeasuredSlices& s, std::size_t offset)
      : MeasuredFunction(table, record, s, offset),
        along(record.I(offset + offsetof(MeasuredWarp, along))),
        before(record.I(offset + offsetof(MeasuredWarp, before))) {}

  struct Point {
    VF x, y, pdf;
  };

  /// Returns the point that maps to (x, y), and the density there.
  LANELIGHT_INLINE Point Invert(VF x, VF y) const {
    const Place p = PlaceOf(x, y);
    const Corners v = CornersOf(p.cell);
    const Rows rows = RowsOf(p.row);
    const VF left = Lerp(p.y, v.v00, v.v01), right = Lerp(p.y, v.v10, v.v11);
    const VF done = Lerp(p.y, Blend(along, p.cell), Blend(along, Above(p.cell)));
    const VF total = Lerp(p.y, rows.low, rows.high);
    const VF here = hn::Add(done, Integral(p.x, left, right));
    const VF down = hn::Add(rows.before, Integral(p.y, rows.low, rows.high));
    return {Share(here, total), hn::Clamp(down, hn::Zero(DF()), Splat(1.0f)),
            Density(Lerp(p.x, left, right))};
  }

  /// Returns the point to which (u, v) is mapped.
  LANELIGHT_INLINE Point Sample(VF u, VF v) const {
    const VI row =
        LastBelow(height, v, [&](VI i) HWY_ATTR { return Blend(before, i, height); });
    const Rows rows = RowsOf(row);
    const VF y = Solve(rows.low, rows.high, hn::Sub(v, rows.before));
    const VF sought = hn::Mul(u, Lerp(y, rows.low, rows.high));
    const VI start = hn::Mul(row, width);
    const auto done = [&](VI i) HWY_ATTR {
      const VI cell = hn::Add(start, i);
      return Lerp(y, Blend(along, cell), Blend(along, Above(cell)));
    };
    const VI column = LastBelow(width, sought, done);
    const Corners c = CornersOf(hn::Add(start, column));
    const VF left = Lerp(y, c.v00, c.v01), right = Lerp(y, c.v10, c.v11);
    const VF x = Solve(left, right, hn::Sub(sought, done(column)));
    return {OfSquare(column, x, width), OfSquare(row, y, height),
            Density(Lerp(x, left, right))};
  }

 private:
  struct Corners {
    VF v00, v10, v01, v11;
  };
  struct Rows {
    VF before, low, high;  // the integral before a row, of it, of the next
  };

  LANELIGHT_INLINE VF Blend(VI first, VI index, VI stride) const {
    VF sum = hn::Zero(DF());
    for (int i = 0; i < slices.count; ++i) {
      const VI slice = hn::Add(first, hn::Mul(slices.at[i], stride));
      sum = hn::MulAdd(Gather(values, hn::Add(slice, index)), slices.fraction[i], sum);
    }
    return sum;
  }
  LANELIGHT_INLINE VF Blend(VI first, VI index) const {
    return Blend(first, index, hn::Mul(width, height));
  }
  LANELIGHT_INLINE VI Above(VI cell) const { return hn::Add(cell, width); }
  LANELIGHT_INLINE Corners CornersOf(VI cell) const {
    const VI one = hn::Set(DI(), 1);
    return {Blend(at, cell), Blend(at, hn::Add(cell, one)), Blend(at, Above(cell)),
            Blend(at, hn::Add(Above(cell), one))};
  }
  LANELIGHT_INLINE Rows RowsOf(VI row) const {
    const VI last = hn::Sub(hn::Add(hn::Mul(row, width), width), hn::Set(DI(), 1));
    return {Blend(before, row, height), Blend(along, last), Blend(along, Above(last))};
  }
  // Integrates a linear function from a to b, up to t in [0, 1].
  LANELIGHT_INLINE static VF Integral(VF t, VF a, VF b) {
    return hn::Mul(t, hn::MulAdd(hn::Mul(Splat(0.5f), t), hn::Sub(b, a), a));
  }
  // Returns the t in [0, 1] up to which that is `integral`, without cancellation.
  LANELIGHT_INLINE static VF Solve(VF a, VF b, VF integral) {
    const VF wanted = hn::Max(integral, hn::Zero(DF()));
    const VF twice = hn::Add(wanted, wanted);
    const VF root = SafeSqrt(hn::MulAdd(twice, hn::Sub(b, a), hn::Mul(a, a)));
    return Share(twice, hn::Add(a, root));
  }
  // Returns part / whole in [0, 1]; 0 / 0 is 0.
  LANELIGHT_INLINE static VF Share(VF part, VF whole) {
    const VF fraction = hn::Clamp(hn::Div(part, whole), hn::Zero(DF()), Splat(1.0f));
    return hn::IfThenElseZero(hn::Gt(whole, hn::Zero(DF())), fraction);
  }
  LANELIGHT_INLINE static VF OfSquare(VI cell, VF t, VI size) {
    const VF cells = hn::ConvertTo(DF(), hn::Sub(size, hn::Set(DI(), 1)));
    return hn::Div(hn::Add(hn::ConvertTo(DF(), cell), t), cells);
  }
  LANELIGHT_INLINE VF Density(VF of_cells) const {
    const VI one = hn::Set(DI(), 1);
    const VI cells = hn::Mul(hn::Sub(width, one), hn::Sub(height, one));
    return hn::Mul(of_cells, hn::ConvertTo(DF(), cells));
  }
};

LANELIGHT_END_KERNELS

#endif
