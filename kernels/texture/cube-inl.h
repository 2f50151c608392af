// Tables over a cube, such as that of colours.
#ifndef LANELIGHT_TEXTURE_CUBE_INL_H_
#define LANELIGHT_TEXTURE_CUBE_INL_H_

#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Adds to `sum` the value of a table of kNodes^3 vectors, x fastest, at coordinates in
/// [0, kNodes - 1]. Interpolates linearly between the four corners of the tetrahedron
/// around the diagonal of the cell.
template <int kNodes>
LANELIGHT_INLINE V3 AddOfCube(const float* table, V3 at, V3 sum) {
  const DI di;
  const VF one = Splat(1.0f);
  const VI last = hn::Set(di, kNodes - 2);
  VI base = hn::Zero(di);
  VF part[3];
  int32_t stride[3] = {1, kNodes, kNodes * kNodes};
  const VF axis[3] = {at.x, at.y, at.z};
  for (int i = 0; i < 3; ++i) {
    const VI cell = hn::Min(hn::ConvertTo(di, axis[i]), last);
    part[i] = hn::Sub(axis[i], hn::ConvertTo(DF(), cell));
    base = hn::Add(base, hn::Mul(cell, hn::Set(di, stride[i])));
  }
  // From corner to corner along the axis of the largest part first, the smallest last.
  const VF high = hn::Max(part[0], hn::Max(part[1], part[2]));
  const VF low = hn::Min(part[0], hn::Min(part[1], part[2]));
  const VF middle =
      hn::Max(hn::Min(part[0], part[1]), hn::Min(hn::Max(part[0], part[1]), part[2]));
  const auto axis_of = [&](VF value) HWY_ATTR {
    const VI second = hn::IfThenElse(hn::RebindMask(di, hn::Eq(part[1], value)),
                                     hn::Set(di, stride[1]), hn::Set(di, stride[2]));
    return hn::IfThenElse(hn::RebindMask(di, hn::Eq(part[0], value)),
                          hn::Set(di, stride[0]), second);
  };
  const VI all = hn::Add(base, hn::Set(di, stride[0] + stride[1] + stride[2]));
  const VI corner[4] = {base, hn::Add(base, axis_of(high)), hn::Sub(all, axis_of(low)),
                        all};
  const VF weight[4] = {hn::Sub(one, high), hn::Sub(high, middle), hn::Sub(middle, low),
                        low};
  for (int i = 0; i < 4; ++i) sum = MulAdd(Gather3(table, corner[i]), weight[i], sum);
  return sum;
}

LANELIGHT_END_KERNELS

#endif
