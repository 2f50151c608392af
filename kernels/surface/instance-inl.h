// Instance maps of a vector of hits: word i of a 3x4 row-major map per lane, identity for
// hits on the world.
#ifndef LANELIGHT_SURFACE_INSTANCE_INL_H_
#define LANELIGHT_SURFACE_INSTANCE_INL_H_

#include "kernels/simd/records-inl.h"
#include "kernels/surface/point-inl.h"
#include "src/compiled/scene.h"

LANELIGHT_BEGIN_KERNELS

struct Map34 {
  V3 row[3];  // linear part
  V3 move;    // translation

  LANELIGHT_INLINE V3 Vector(V3 v) const {
    return {Dot(row[0], v), Dot(row[1], v), Dot(row[2], v)};
  }
  /// Transposed linear part: maps normals when the map is the inverse.
  LANELIGHT_INLINE V3 Transposed(V3 n) const {
    return MulAdd(row[0], n.x, MulAdd(row[1], n.y, Mul(row[2], n.z)));
  }
  /// |linear part| v + |translation|, the bound of a mapped point with |coordinates| v.
  LANELIGHT_INLINE V3 Bound(V3 v) const {
    return Map34{{Abs(row[0]), Abs(row[1]), Abs(row[2])}, move}.Vector(v) + Abs(move);
  }
};

struct InstanceMaps {
  Map34 object_from_scene, scene_from_object;
};

/// `inst` is -1 for the world.
LANELIGHT_INLINE InstanceMaps GatherMaps(const AlignedVector<InstanceRecord>& records,
                                         VI inst) {
  const DI di;
  const MF world = hn::RebindMask(DF(), hn::Lt(inst, hn::Zero(di)));
  const RecordWords record(records.data(), hn::Max(inst, hn::Zero(di)));
  const auto map = [&](std::size_t byte_offset) HWY_ATTR {
    const auto word = [&](std::size_t row, std::size_t column) HWY_ATTR {
      const VF value = record.F(byte_offset + (4 * row + column) * sizeof(float));
      return hn::IfThenElse(world, Splat(row == column ? 1.0f : 0.0f), value);
    };
    Map34 result;
    for (std::size_t r = 0; r < 3; ++r) {
      result.row[r] = {word(r, 0), word(r, 1), word(r, 2)};
    }
    result.move = {word(0, 3), word(1, 3), word(2, 3)};
    return result;
  };
  return {map(offsetof(InstanceRecord, object_from_scene)),
          map(offsetof(InstanceRecord, scene_from_object))};
}

template <bool kUpper>
LANELIGHT_INLINE D3 MapPoint(const Map34& m, D3 p) {
  const D3 move = HalfOf<kUpper>(m.move);
  return {hn::Add(Dot(HalfOf<kUpper>(m.row[0]), p), move.x),
          hn::Add(Dot(HalfOf<kUpper>(m.row[1]), p), move.y),
          hn::Add(Dot(HalfOf<kUpper>(m.row[2]), p), move.z)};
}

/// Along n (scene space), how far a ray origin may move when it is mapped to the object:
/// mapping rounds 4u (|M| |p| + |m|) per coordinate, and since both maps were rounded to
/// float, M S is the identity only within 2u |M| (|S| |p_object| + |s|); u = 2^-24. Twice
/// their sum is 12u times the larger bound.
LANELIGHT_INLINE VF MappingError(const InstanceMaps& maps, V3 p_object, V3 n) {
  const V3 reach = maps.scene_from_object.Bound(Abs(p_object));
  const V3 in_object = maps.object_from_scene.Bound(reach);
  const Map34& s = maps.scene_from_object;
  const Map34 abs_s{{Abs(s.row[0]), Abs(s.row[1]), Abs(s.row[2])}, s.move};
  return hn::Mul(Splat(12 * 0x1p-24f), Dot(Abs(n), abs_s.Vector(in_object)));
}

LANELIGHT_END_KERNELS

#endif
