// Cells of CellGrid (src/scene/prepare/tables.h).
#ifndef LANELIGHT_QUEUE_GRID_CELL_INL_H_
#define LANELIGHT_QUEUE_GRID_CELL_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/prepare/tables.h"

LANELIGHT_BEGIN_KERNELS

// Returns the cell along one axis; points outside the box (infinite planes) belong to its
// border.
LANELIGHT_INLINE VI CellAlong(const CellGrid& grid, int axis, VF p) {
  const VF last = Splat(static_cast<float>(grid.size[axis] - 1));
  const VF at = hn::Mul(hn::Sub(p, Splat(grid.low[axis])), Splat(grid.per_unit[axis]));
  return hn::ConvertTo(DI(), hn::Min(hn::Max(at, hn::Zero(DF())), last));
}

/// Returns the cells of the surface points of these paths, by the side that they see.
LANELIGHT_INLINE VI CellOf(const CellGrid& grid, const PathColumns& path,
                           const Slots& slots) {
  const DI di;
  const auto constant = [&](int32_t v) HWY_ATTR { return hn::Set(di, v); };
  const V3 p = Gather3(path.p_x, path.p_y, path.p_z, slots);
  V3 n = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
  const V3 d = Gather3(path.d_x, path.d_y, path.d_z, slots);
  n = IfThenElse(hn::Gt(Dot(n, d), hn::Zero(DF())), -n, n);
  const VF ax = hn::Abs(n.x), ay = hn::Abs(n.y), az = hn::Abs(n.z);
  const MF is_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az)), is_y = hn::Ge(ay, az);
  const VF along = hn::IfThenElse(is_x, n.x, hn::IfThenElse(is_y, n.y, n.z));
  const VI axis =
      hn::IfThenElse(hn::RebindMask(di, is_x), constant(0),
                     hn::IfThenElse(hn::RebindMask(di, is_y), constant(2), constant(4)));
  const VI face =
      hn::Add(axis, hn::IfThenElse(hn::RebindMask(di, hn::Lt(along, hn::Zero(DF()))),
                                   constant(1), constant(0)));
  const VI x = CellAlong(grid, 0, p.x), y = CellAlong(grid, 1, p.y);
  const VI z = CellAlong(grid, 2, p.z);
  const VI row = hn::Add(y, hn::Mul(z, constant(grid.size[1])));
  const VI index = hn::Add(x, hn::Mul(row, constant(grid.size[0])));
  return hn::Add(hn::Mul(index, constant(6)), face);
}

LANELIGHT_END_KERNELS

#endif
