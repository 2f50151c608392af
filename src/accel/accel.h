// Acceleration structure over the triangles, spheres and disks of a scene.
#pragma once

namespace lanelight {

struct Accel {};

}  // namespace lanelight
