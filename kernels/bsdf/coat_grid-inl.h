// Tables of coats whose roughness or thickness is textured: a grid of the tables of
// src/scene/compile/coat.h, interpolated per path.
#ifndef LANELIGHT_BSDF_COAT_GRID_INL_H_
#define LANELIGHT_BSDF_COAT_GRID_INL_H_

#include "kernels/bsdf/bsdf-inl.h"

LANELIGHT_BEGIN_KERNELS

/// The four tables around a coat, two roughnesses for each of two thicknesses, and their
/// weights. An axis of one node has that node twice.
struct CoatCell {
  VI table[4];
  VF weight[4];

  LANELIGHT_INLINE static CoatCell Of(const MaterialInputs& in) {
    const MaterialTable& t = in.table;
    const VF alpha = hn::Sqrt(hn::Mul(in.AlphaX(), in.AlphaY()));
    const VF one = Splat(1.0f);
    const VI alphas = in.Int(t.coat_alphas);
    const Axis a(hn::Div(alpha, hn::Add(one, alpha)), alphas);
    const VF absorbed = hn::Sub(one, Exp(hn::Neg(in.CoatThickness())));
    const Axis d(SafeSqrt(absorbed), in.Int(t.coat_depths));
    const VI first = hn::ShiftRight<6>(in.Int(t.coat));
    static_assert(kCoatTableSize == 1 << 6);
    CoatCell cell;
    for (int i = 0; i < 4; ++i) {
      const VI row = hn::Mul(i < 2 ? d.low : d.high, alphas);
      cell.table[i] = hn::Add(first, hn::Add(row, i % 2 == 0 ? a.low : a.high));
      cell.weight[i] = hn::Mul(i < 2 ? hn::Sub(one, d.part) : d.part,
                               i % 2 == 0 ? hn::Sub(one, a.part) : a.part);
    }
    return cell;
  }

  /// Returns the fraction of the light leaving the base that the coat reflects back to
  /// it.
  LANELIGHT_INLINE VF Internal(const MaterialTable& t) const {
    VF sum = hn::Zero(DF());
    for (int i = 0; i < 4; ++i) {
      sum = hn::MulAdd(weight[i], Gather(t.coat_internals.data(), table[i]), sum);
    }
    return sum;
  }
  /// Returns the transmittance at entry `cell` of the tables; `part` of the way to the
  /// next one.
  LANELIGHT_INLINE VF Transmittance(const float* tables, VI cell, VF part) const {
    VF sum = hn::Zero(DF());
    for (int i = 0; i < 4; ++i) {
      const VI at = hn::Add(hn::ShiftLeft<6>(table[i]), cell);
      const VF low = Gather(tables, at), high = Gather(tables + 1, at);
      sum = hn::MulAdd(weight[i], hn::MulAdd(part, hn::Sub(high, low), low), sum);
    }
    return sum;
  }

 private:
  struct Axis {
    VI low, high;
    VF part;  // of `high`

    /// x in [0, 1] over `nodes` nodes.
    LANELIGHT_INLINE Axis(VF x, VI nodes) {
      const DI di;
      const DF df;
      const VI last = hn::Sub(nodes, hn::Set(di, 1));
      const VF at =
          hn::Mul(hn::Clamp(x, hn::Zero(df), Splat(1.0f)), hn::ConvertTo(df, last));
      low = hn::Min(hn::ConvertTo(di, at), last);
      high = hn::Min(hn::Add(low, hn::Set(di, 1)), last);
      part = hn::Sub(at, hn::ConvertTo(df, low));
    }
  };
};

LANELIGHT_END_KERNELS

#endif
