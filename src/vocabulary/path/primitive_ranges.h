// The ranges of primitive ids, by shape.
#pragma once

#include <cstdint>

namespace lanelight {

/// A primitive id counts triangles first, then spheres, disks, planes, large spheres,
/// curves.
struct PrimitiveRanges {
  // The first id of each, and the end.
  std::uint32_t spheres = 0, disks = 0, planes = 0, large_spheres = 0, curves = 0,
                end = 0;
};

}  // namespace lanelight
