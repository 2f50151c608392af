// What a medium's emission is multiplied with at a point.
#ifndef LANELIGHT_MEDIA_EMISSION_INL_H_
#define LANELIGHT_MEDIA_EMISSION_INL_H_

#include "hwy/contrib/math/math-inl.h"

#include "kernels/media/voxels-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Colour of a black body of (t - offset) * scale kelvin; none up to kLeastKelvin.
LANELIGHT_INLINE V3 BlackbodyColor(const BlackbodyTable& table, VF t) {
  const DI di;
  const VF least = Splat(kLeastKelvin);
  const VF kelvin = hn::Mul(hn::Sub(t, Splat(table.offset)), Splat(table.scale));
  const VF ratio = hn::Mul(hn::Max(kelvin, least), Splat(1 / kLeastKelvin));
  const VF at = hn::Mul(hn::Log(DF(), ratio), Splat(table.entries_per_log));
  // There are two entries at least.
  const auto last = static_cast<float>(table.colors.size() / 3 - 2);
  const VF low = hn::Clamp(hn::Floor(at), Splat(0), Splat(last));
  const VF share = hn::Sub(at, low);
  const VI entry = hn::Mul(hn::ConvertTo(di, low), hn::Set(di, 3));
  const auto channel = [&](int c) HWY_ATTR {
    const VF a = Gather(table.colors.data() + c, entry);
    const VF b = Gather(table.colors.data() + 3 + c, entry);
    return hn::MulAdd(share, hn::Sub(b, a), a);
  };
  return IfThenElseZero(hn::Gt(kelvin, least), V3{channel(0), channel(1), channel(2)});
}

/// At p of the box, in the lanes of `mask`.
inline HWY_NOINLINE V3 EmissionFactor(const MediumGrid& grid, V3 p, MF mask) {
  const MediumEmission& emission = grid.emission;
  V3 factor = Splat3(1, 1, 1);
  if (!emission.values.empty()) {
    VF v[3];
    Interpolate(grid.size, emission.values.data(), emission.channels, p, v);
    factor = emission.channels == 1 ? V3{v[0], v[0], v[0]} : V3{v[0], v[1], v[2]};
  }
  if (emission.blackbody.colors.empty()) return factor;
  VF t;
  if (emission.sparse.grid != nullptr) {
    t = SparseValue(emission.sparse, p, mask);
  } else {
    Interpolate(grid.size, emission.temperatures.data(), 1, p, &t);
  }
  return Mul(factor, BlackbodyColor(emission.blackbody, t));
}

LANELIGHT_END_KERNELS

#endif
