// Instance maps of a vector of hits: word i of a 3x4 row-major map per lane, identity for
// hits on the world.
#ifndef LANELIGHT_SURFACE_INSTANCE_INL_H_
#define LANELIGHT_SURFACE_INSTANCE_INL_H_

#include "kernels/simd/motion-inl.h"
#include "kernels/simd/records-inl.h"
#include "kernels/surface/point-inl.h"
#include "src/scene/geometry/geometry.h"

LANELIGHT_BEGIN_KERNELS

struct InstanceMaps {
  Map34 object_from_scene, scene_from_object;

  /// Takes the linear parts and moves of others for the lanes of the mask.
  LANELIGHT_INLINE void Replace(MF mask, const InstanceMaps& others) {
    const auto replace = [&](Map34& map, const Map34& other) HWY_ATTR {
      for (int r = 0; r < 3; ++r) {
        map.row[r] = IfThenElse(mask, other.row[r], map.row[r]);
      }
      map.move = IfThenElse(mask, other.move, map.move);
    };
    replace(object_from_scene, others.object_from_scene);
    replace(scene_from_object, others.scene_from_object);
  }
};

/// `inst` is -1 for the world.
LANELIGHT_INLINE InstanceMaps GatherMaps(const AlignedVector<InstanceRecord>& records,
                                         VI inst) {
  const MF world = hn::RebindMask(DF(), hn::Lt(inst, hn::Zero(DI())));
  const RecordWords record(records.data(), hn::Max(inst, hn::Zero(DI())));
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

/// Lanes whose instances move, their maps at the times of the paths, and the parts of
/// which the maps are composed.
struct MovingLanes {
  MF moves;
  InstanceMaps maps;
  V3 at, pivot;
};

LANELIGHT_INLINE MovingLanes GatherMotions(const AlignedVector<MotionRecord>& motions,
                                           VI inst, VF time) {
  const auto count = hn::Set(DI(), static_cast<int32_t>(motions.size()));
  const auto moves = hn::AndNot(hn::Lt(inst, hn::Zero(DI())), hn::Lt(inst, count));
  const RecordWords words(motions.data(), hn::IfThenElseZero(moves, inst));
  const MovedSpace space = SpaceAt(words, time);
  return {hn::RebindMask(DF(), moves),
          {space.Back(), space.Forward()},
          space.at,
          space.pivot};
}

template <bool kUpper>
LANELIGHT_INLINE D3 MapPoint(const Map34& m, D3 p) {
  const D3 move = HalfOf<kUpper>(m.move);
  return {hn::Add(Dot(HalfOf<kUpper>(m.row[0]), p), move.x),
          hn::Add(Dot(HalfOf<kUpper>(m.row[1]), p), move.y),
          hn::Add(Dot(HalfOf<kUpper>(m.row[2]), p), move.z)};
}

/// n . |linear part| v
LANELIGHT_INLINE VF LengthAlong(const Map34& map, V3 n, V3 v) {
  const Map34 linear{{Abs(map.row[0]), Abs(map.row[1]), Abs(map.row[2])}, map.move};
  return Dot(Abs(n), linear.Vector(v));
}

/// Returns how far along n (scene space) a ray origin may move when it is mapped to the
/// object: mapping rounds 4u (|M| |p| + |m|) per coordinate, and since both maps were
/// rounded to float, M S is the identity only within 2u |M| (|S| |p_object| + |s|); u =
/// 2^-24. Twice their sum is 12u times the larger bound.
LANELIGHT_INLINE VF MappingError(const InstanceMaps& maps, V3 p_object, V3 n) {
  const V3 reach = maps.scene_from_object.Bound(Abs(p_object));
  const V3 in_object = maps.object_from_scene.Bound(reach);
  return hn::Mul(Splat(12 * 0x1p-24f), LengthAlong(maps.scene_from_object, n, in_object));
}

/// Does the same for moving instances. Their maps are composed in float: turning and
/// inverting add 20u to the bound of each part, since the parts cancel in sums.
LANELIGHT_INLINE VF MovingError(const MovingLanes& moving, V3 p_object, V3 n) {
  const auto& [object_from_scene, scene_from_object] = moving.maps;
  const Map34 forward = {
      {scene_from_object.row[0], scene_from_object.row[1], scene_from_object.row[2]},
      moving.at};
  const Map34 back = {
      {object_from_scene.row[0], object_from_scene.row[1], object_from_scene.row[2]},
      moving.pivot};
  const V3 reach = forward.Bound(Abs(p_object) + Abs(moving.pivot));
  return hn::Mul(Splat(64 * 0x1p-24f), LengthAlong(forward, n, back.Bound(reach)));
}

LANELIGHT_END_KERNELS

#endif
