// Opacity by textures that depend on where a point is. A call across targets, so that the
// patterns of such textures are not a part of every intersection kernel.
#pragma once

#include <cstdint>

#include "src/compiled/texture_table.h"

namespace lanelight {

/// A point of a surface and its unit normal, scene space.
struct PointOfAlpha {
  float p[3], n[3];
};

/// Value of float texture `texture` >= 0 there, at surface coordinates (u, v).
float AlphaAtPlace(const TextureTable& table, std::int32_t texture, float u, float v,
                   const PointOfAlpha& at);

}  // namespace lanelight
