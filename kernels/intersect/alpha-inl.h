// Alpha cut-outs: whether a candidate hit counts. Scalar, since few scenes have them and
// few candidates need it.
#ifndef LANELIGHT_INTERSECT_ALPHA_INL_H_
#define LANELIGHT_INTERSECT_ALPHA_INL_H_

#include <bit>

#include "kernels/texture/alpha-inl.h"
#include "kernels/texture/texture-inl.h"
#include "src/scene/compiled/texture_table.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

/// Opacity of primitive `prim` at (u, v), in [0, 1]; outside values mean the nearest end.
/// where() -> PointOfAlpha: asked for by textures that depend on it alone.
template <class Where>
inline float AlphaAt(const SceneParts& scene, uint32_t prim, float u, float v,
                     Where&& where) {
  const int32_t id = scene.alpha->texture[prim];
  if (id >= 0 && scene.textures->programs[id].uses_place) {
    return AlphaAtPlace(*scene.textures, id, u, v, where());
  }
  return EvalAlphaAt(*scene.textures, id, u, v, scene.alpha->constant[prim]);
}

/// Uniform number in [0, 1) from the bits of a ray and a primitive: the same ray makes
/// the same decision about a primitive, whatever else happens.
inline float AlphaHash(const float o[3], const float d[3], uint32_t prim) {
  uint32_t h = prim * 0x9e3779b1u + 0x7f4a7c15u;
  for (int i = 0; i < 6; ++i) {
    h ^= std::bit_cast<uint32_t>(i < 3 ? o[i] : d[i - 3]);
    h *= 0x85ebca6bu;
    h ^= h >> 15;
    h *= 0xc2b2ae35u;
    h ^= h >> 13;
  }
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

/// A point of a triangle and its normal, in its own space.
inline PointOfAlpha PointOf(const TriangleRecord& r, float b1, float b2) {
  PointOfAlpha at;
  float edge1[3], edge2[3];
  for (int i = 0; i < 3; ++i) {
    edge1[i] = r.p[1][i] - r.p[0][i];
    edge2[i] = r.p[2][i] - r.p[0][i];
    at.p[i] = r.p[0][i] + b1 * edge1[i] + b2 * edge2[i];
  }
  const Vec3f n =
      Cross(Vec3f{edge1[0], edge1[1], edge1[2]}, Vec3f{edge2[0], edge2[1], edge2[2]});
  const float scale = 1 / Length(n);
  at.n[0] = n.x * scale, at.n[1] = n.y * scale, at.n[2] = n.z * scale;
  return at;
}

/// A hit on a triangle: barycentric weights of the second and third vertex.
struct TrianglePlace {
  uint32_t prim;
  float b1, b2;
};

/// Returns whether a candidate hit of ray (o, d), in scene space, counts: with
/// probability alpha.
inline bool TrianglePassesAlpha(const SceneParts& scene, const float o[3],
                                const float d[3], const TrianglePlace& at) {
  const auto [prim, b1, b2] = at;
  if (!(scene.geometry->triangles[prim].flags & kAlphaTested)) return true;
  float u = b1 + b2, v = b2;  // without uvs: (0,0), (1,0), (1,1), as in pbrt
  if (!scene.geometry->uvs.empty()) {
    const float* uv = &scene.geometry->uvs[std::size_t{6} * prim];
    const float b0 = 1 - b1 - b2;
    u = b0 * uv[0] + b1 * uv[2] + b2 * uv[4];
    v = b0 * uv[1] + b1 * uv[3] + b2 * uv[5];
  }
  const float alpha = AlphaAt(scene, prim, u, v, [&]() HWY_ATTR {
    return PointOf(scene.geometry->triangles[at.prim], at.b1, at.b2);
  });
  return AlphaHash(o, d, prim) < alpha;
}

LANELIGHT_END_KERNELS

#endif
