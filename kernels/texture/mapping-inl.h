// Computes texture coordinates, from surface coordinates or from the position of a point.
#ifndef LANELIGHT_TEXTURE_MAPPING_INL_H_
#define LANELIGHT_TEXTURE_MAPPING_INL_H_

#include "kernels/simd/math-inl.h"
#include "src/scene/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

/// A point for textures that depend on its surface coordinates alone.
struct UvPoint {
  static constexpr bool kHasPlace = false, kHasFootprint = false;
  VF u, v;

  /// Keeps the lanes of `mine`; the others get one common point.
  LANELIGHT_INLINE UvPoint Only(MF mine) const {
    return {hn::IfThenElseZero(mine, u), hn::IfThenElseZero(mine, v)};
  }
};

/// A point for all textures: p of the scene, n the geometric normal (unit, either way).
struct PlacedPoint {
  static constexpr bool kHasPlace = true, kHasFootprint = false;
  VF u, v;
  V3 p, n;

  LANELIGHT_INLINE PlacedPoint Only(MF mine) const {
    return {hn::IfThenElseZero(mine, u), hn::IfThenElseZero(mine, v),
            IfThenElseZero(mine, p), n};
  }
};

/// Steps in surface coordinates from one pixel to the next.
struct Footprint {
  VF dudx, dudy, dvdx, dvdy;

  LANELIGHT_INLINE Footprint Only(MF mask) const {
    return {hn::IfThenElseZero(mask, dudx), hn::IfThenElseZero(mask, dudy),
            hn::IfThenElseZero(mask, dvdx), hn::IfThenElseZero(mask, dvdy)};
  }
};

/// A point for all textures, which are filtered; p and n as in PlacedPoint. The steps
/// from one pixel to the next along the surface are read by mappings of places.
struct FilteredPoint {
  static constexpr bool kHasPlace = true, kHasFootprint = true;
  VF u, v;
  V3 p, n;
  Footprint footprint;
  V3 step_x, step_y;

  LANELIGHT_INLINE void SetSteps(V3 tg, V3 tv) {
    step_x = MulAdd(tg, footprint.dudx, Mul(tv, footprint.dvdx));
    step_y = MulAdd(tg, footprint.dudy, Mul(tv, footprint.dvdy));
  }
  LANELIGHT_INLINE FilteredPoint Only(MF mine) const {
    return {hn::IfThenElseZero(mine, u), hn::IfThenElseZero(mine, v),
            IfThenElseZero(mine, p),     n,
            footprint.Only(mine),        IfThenElseZero(mine, step_x),
            IfThenElseZero(mine, step_y)};
  }
};

struct TexturePair {
  VF s, t;
};

/// Row `row` of the node's map, times (p, 1).
LANELIGHT_INLINE VF PlaceRow(const TextureNode& node, int row, V3 p) {
  const float* m = node.place[row];
  return hn::MulAdd(
      p.x, Splat(m[0]),
      hn::MulAdd(p.y, Splat(m[1]), hn::MulAdd(p.z, Splat(m[2]), Splat(m[3]))));
}

/// p in the space of a pattern.
LANELIGHT_INLINE V3 PlaceOf(const TextureNode& node, V3 p) {
  return {PlaceRow(node, 0, p), PlaceRow(node, 1, p), PlaceRow(node, 2, p)};
}

/// Angle about the z axis, in turns: [0, 1) from +x for spheres, and from -x for
/// cylinders (as pbrt-v4).
LANELIGHT_INLINE VF TurnsAboutZ(V3 q, bool from_x) {
  const VF turns = hn::Mul(Atan2(q.y, q.x), Splat(0.159154943f));  // [-1/2, 1/2]
  if (!from_x) return hn::Add(turns, Splat(0.5f));
  return hn::IfThenElse(hn::Lt(turns, hn::Zero(DF())), hn::Add(turns, Splat(1.0f)),
                        turns);
}

/// Coordinates of the lookup by the node's mapping. Spherical: (angle to +z / pi, turns
/// about z); cylindrical: (turns, z); planar: the map itself.
template <class Point>
LANELIGHT_INLINE TexturePair MapPoint(const TextureNode& node, const Point& at) {
  if constexpr (Point::kHasPlace) {
    if (node.mapping != MappingKind::kUv) {
      const V3 q = PlaceOf(node, at.p);
      if (node.mapping == MappingKind::kPlanar) return {q.x, q.y};
      if (node.mapping == MappingKind::kCylindrical) return {TurnsAboutZ(q, false), q.z};
      const VF across = hn::Sqrt(hn::MulAdd(q.x, q.x, hn::Mul(q.y, q.y)));
      return {hn::Mul(Atan2(across, q.z), Splat(0.318309886f)), TurnsAboutZ(q, true)};
    }
  }
  return {hn::MulAdd(at.u, Splat(node.su), Splat(node.du)),
          hn::MulAdd(at.v, Splat(node.sv), Splat(node.dv))};
}

/// The steps to the next pixel, in texture coordinates.
struct MapSteps {
  VF s_x, t_x, s_y, t_y;
};

/// Returns the steps at a point with a footprint, by the node's mapping.
template <class Point>
LANELIGHT_INLINE MapSteps StepsOf(const TextureNode& node, const Point& at) {
  if (node.mapping == MappingKind::kUv) {
    const VF su = Splat(node.su), sv = Splat(node.sv);
    return {hn::Mul(at.footprint.dudx, su), hn::Mul(at.footprint.dvdx, sv),
            hn::Mul(at.footprint.dudy, su), hn::Mul(at.footprint.dvdy, sv)};
  }
  const auto turned = [&](V3 v) HWY_ATTR {
    const auto row = [&](int r) HWY_ATTR {
      const float* m = node.place[r];
      return Dot(v, Splat3(m[0], m[1], m[2]));
    };
    return V3{row(0), row(1), row(2)};
  };
  const V3 x = turned(at.step_x), y = turned(at.step_y);
  if (node.mapping == MappingKind::kPlanar) return {x.x, x.y, y.x, y.y};
  const V3 q = PlaceOf(node, at.p);
  const VF tiny = Splat(1e-20f), per_turn = Splat(0.159154943f);
  const VF across2 = hn::Max(hn::MulAdd(q.x, q.x, hn::Mul(q.y, q.y)), tiny);
  const VF turn = hn::Div(per_turn, across2);
  const V3 around = {hn::Neg(hn::Mul(q.y, turn)), hn::Mul(q.x, turn), hn::Zero(DF())};
  if (node.mapping == MappingKind::kCylindrical) {
    return {Dot(around, x), x.z, Dot(around, y), y.z};
  }
  const VF across = hn::Sqrt(across2);
  const VF scale =
      hn::Div(Splat(0.318309886f), hn::Mul(across, hn::MulAdd(q.z, q.z, across2)));
  const V3 down = Mul(V3{hn::Mul(q.x, q.z), hn::Mul(q.y, q.z), hn::Neg(across2)}, scale);
  return {Dot(down, x), Dot(around, x), Dot(down, y), Dot(around, y)};
}

LANELIGHT_END_KERNELS

#endif
