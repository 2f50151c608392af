// What a tree is of, in 128 bits.
#pragma once

#include "src/base/core/hash.h"
#include "src/scene/accel/accel.h"

namespace lanelight {

using TreeKey = Hash128;

/// XXH3 (128 bits) of everything that BuildAccel reads: places of shapes, groups,
/// instances and options. Materials, lights, normals and texture coordinates are not in
/// it.
TreeKey KeyOf(const Geometry& geometry, const AccelOptions& options);

}  // namespace lanelight
