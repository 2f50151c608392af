// Affine maps, one per lane, and those of motions (src/base/core/motion_record.h) at the
// times of lanes.
#ifndef LANELIGHT_SIMD_MOTION_INL_H_
#define LANELIGHT_SIMD_MOTION_INL_H_

#include <cstddef>

#include "kernels/simd/math-inl.h"
#include "src/base/core/motion_record.h"

LANELIGHT_BEGIN_KERNELS

struct Map34 {
  V3 row[3];  // linear part
  V3 move;    // translation

  LANELIGHT_INLINE V3 Vector(V3 v) const {
    return {Dot(row[0], v), Dot(row[1], v), Dot(row[2], v)};
  }
  LANELIGHT_INLINE V3 Point(V3 p) const { return Vector(p) + move; }
  /// Transposed linear part: maps normals when the map is the inverse.
  LANELIGHT_INLINE V3 Transposed(V3 n) const {
    return MulAdd(row[0], n.x, MulAdd(row[1], n.y, Mul(row[2], n.z)));
  }
  /// |linear part| v + |translation|, the bound of a mapped point with |coordinates| v.
  LANELIGHT_INLINE V3 Bound(V3 v) const {
    return Map34{{Abs(row[0]), Abs(row[1]), Abs(row[2])}, move}.Vector(v) + Abs(move);
  }
};

/// The words of one motion, for all lanes; RecordWords has those of one per lane.
struct OneMotion {
  const MotionRecord& record;

  LANELIGHT_INLINE V3 F3(std::size_t byte_offset) const {
    return {F(byte_offset), F(byte_offset + 4), F(byte_offset + 8)};
  }
  LANELIGHT_INLINE VF F(std::size_t byte_offset) const {
    return Splat(reinterpret_cast<const float*>(&record)[byte_offset / 4]);
  }
};

/// p -> at + unit (column) (pivot + p), where motions have brought things by some time.
struct MovedSpace {
  V3 column[3];
  V3 at, pivot;
  VF unit;

  LANELIGHT_INLINE Map34 Forward() const {
    const V3 x = Mul(column[0], unit), y = Mul(column[1], unit), z = Mul(column[2], unit);
    Map34 map = {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}, at};
    map.move = map.Point(pivot);
    return map;
  }
  LANELIGHT_INLINE Map34 Back() const {
    const V3 x = Cross(column[1], column[2]);
    const VF inverse = hn::Div(Splat(1.0f), hn::Mul(unit, Dot(column[0], x)));
    Map34 map;
    map.row[0] = Mul(x, inverse);
    map.row[1] = Mul(Cross(column[2], column[0]), inverse);
    map.row[2] = Mul(Cross(column[0], column[1]), inverse);
    map.move = -(map.Vector(at) + pivot);
    return map;
  }
};

/// The space of a motion at the times of lanes, 0 to 1.
template <class Words>
LANELIGHT_INLINE MovedSpace SpaceAt(const Words& record, VF time) {
  const auto turn = SinCos2Pi(hn::Mul(record.F(offsetof(MotionRecord, turns)), time));
  const V3 axis = record.F3(offsetof(MotionRecord, axis));
  const VF rest = hn::Sub(Splat(1.0f), turn.cos);
  MovedSpace space;
  for (std::size_t c = 0; c < 3; ++c) {
    const V3 v =
        MulAdd(record.F3(offsetof(MotionRecord, change) + c * sizeof(float[3])), time,
               record.F3(offsetof(MotionRecord, linear) + c * sizeof(float[3])));
    // Rodrigues' formula.
    space.column[c] = MulAdd(Cross(axis, v), turn.sin,
                             MulAdd(axis, hn::Mul(rest, Dot(axis, v)), Mul(v, turn.cos)));
  }
  space.at = MulAdd(record.F3(offsetof(MotionRecord, way)), time,
                    record.F3(offsetof(MotionRecord, from)));
  space.pivot = record.F3(offsetof(MotionRecord, pivot));
  space.unit = record.F(offsetof(MotionRecord, unit));
  return space;
}

LANELIGHT_END_KERNELS

#endif
