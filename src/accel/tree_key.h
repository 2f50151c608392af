// What a tree is of, in 128 bits.
#pragma once

#include <cstdint>

#include "src/accel/accel.h"
#include "src/core/hash.h"

namespace lanelight {

/// Raised whenever BuildAccel makes other trees of the same shapes, or members of Accel
/// mean something else. (Their sizes and the commit that the program was built from are
/// part of the key anyway.)
inline constexpr std::uint64_t kTreeVersion = 5;

using TreeKey = Hash128;

/// XXH3 (128 bits) of everything that BuildAccel reads: places of shapes, groups,
/// instances and options; and of this program. Materials, lights, normals and texture
/// coordinates are not in it.
TreeKey KeyOf(const Geometry& geometry, const AccelOptions& options);

}  // namespace lanelight
