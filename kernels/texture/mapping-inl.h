// Where a texture is looked up: at surface coordinates, or at the place of a point.
#ifndef LANELIGHT_TEXTURE_MAPPING_INL_H_
#define LANELIGHT_TEXTURE_MAPPING_INL_H_

#include "kernels/simd/math-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

/// A point for textures that depend on its surface coordinates alone.
struct UvPoint {
  static constexpr bool kHasPlace = false, kHasFootprint = false;
  VF u, v;

  /// The lanes of `mine`; the others look at one place.
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

LANELIGHT_END_KERNELS

#endif
