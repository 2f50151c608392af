// Opacity by textures that depend on the position. A call, so that intersection kernels
// do not contain the patterns of such textures.
#ifndef LANELIGHT_TEXTURE_ALPHA_INL_H_
#define LANELIGHT_TEXTURE_ALPHA_INL_H_

#include "kernels/simd/each_target-inl.h"
#include "src/scene/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

/// A point of a surface and its unit normal, scene space.
struct PointOfAlpha {
  float p[3], n[3];
};

/// Returns the value of float texture `texture` >= 0 there, at surface coordinates (u,
/// v).
float AlphaAtPlace(const TextureTable& table, int32_t texture, float u, float v,
                   const PointOfAlpha& at);

LANELIGHT_END_KERNELS

#endif
