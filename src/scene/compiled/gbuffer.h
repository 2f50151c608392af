// The space in which --gbuffer says where first hits are.
#pragma once

#include "src/base/core/vec.h"

namespace lanelight {

/// Scene space to camera or world space, in its own units: a point p lies at
/// (x . (p - from), y . (p - from), z . (p - from)) + to. A normal n has the direction
/// (normal_x . n, normal_y . n, normal_z . n).
struct GbufferSpace {
  Vec3f from, to;
  Vec3f x, y, z;
  Vec3f normal_x, normal_y, normal_z;
  bool of_camera = false;  // else of the world
};

}  // namespace lanelight
