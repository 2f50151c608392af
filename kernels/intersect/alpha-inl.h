// Alpha cut-outs: whether a candidate hit counts. Scalar, since few scenes have them and
// few candidates need it.
#if defined(LANELIGHT_INTERSECT_ALPHA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_ALPHA_INL_H_
#undef LANELIGHT_INTERSECT_ALPHA_INL_H_
#else
#define LANELIGHT_INTERSECT_ALPHA_INL_H_
#endif

#include <bit>

#include "kernels/texture/texture-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// Opacity of primitive `prim` at (u, v), in [0, 1]; outside values mean the nearest end.
inline float AlphaAt(const CompiledScene& scene, uint32_t prim, float u, float v) {
  return EvalAlphaAt(scene.textures, scene.alpha_texture[prim], u, v,
                     scene.alpha_constant[prim]);
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

/// Whether a candidate hit of ray (o, d), in scene space, at surface coordinates (u, v)
/// counts: with probability alpha.
inline bool PassesAlpha(const CompiledScene& scene, const float o[3], const float d[3],
                        uint32_t prim, float u, float v) {
  return AlphaHash(o, d, prim) < AlphaAt(scene, prim, u, v);
}

/// The same for a triangle at barycentric weights b1, b2.
inline bool TrianglePassesAlpha(const CompiledScene& scene, const float o[3],
                                const float d[3], uint32_t prim, float b1, float b2) {
  if (!(scene.geometry.triangles[prim].flags & kAlphaTested)) return true;
  float u = b1 + b2, v = b2;  // without uvs: (0,0), (1,0), (1,1), as in pbrt
  if (!scene.geometry.uvs.empty()) {
    const float* uv = &scene.geometry.uvs[std::size_t{6} * prim];
    const float b0 = 1 - b1 - b2;
    u = b0 * uv[0] + b1 * uv[2] + b2 * uv[4];
    v = b0 * uv[1] + b1 * uv[3] + b2 * uv[5];
  }
  return PassesAlpha(scene, o, d, prim, u, v);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
