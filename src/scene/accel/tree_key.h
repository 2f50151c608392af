// What a tree is of, in 128 bits.
#pragma once

#include "src/base/core/hash.h"

namespace lanelight {

struct AccelOptions;  // src/scene/accel/build.h
struct Geometry;      // src/scene/geometry/geometry.h

using TreeKey = Hash128;

/// XXH3 (128 bits) of everything that BuildAccel reads: places of shapes, groups,
/// instances and options. Materials, lights, normals and texture coordinates are not in
/// it.
TreeKey KeyOf(const Geometry& geometry, const AccelOptions& options);

}  // namespace lanelight
