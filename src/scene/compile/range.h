// What float32 holds of a scene, in scene coordinates (frame.h), whose unit is about the
// size of the scene, or of the part of it that the camera sees up close.
//
// Kernels square distances and sizes. So the squares of all coordinates, and the sums of
// three of them, are to lie below 2^128, and the squares of sizes to be normal numbers,
// from 2^-126 on. What lies farther off is refused where it stands: it would be at no
// place. What is smaller is left out with a note, as degenerate triangles are: there is
// nothing to see of it.
#pragma once

#include <vector>

#include "src/scene/compile/placement.h"

namespace lanelight {

inline constexpr double kFarthestInScene = 0x1p62, kSmallestInScene = 0x1p-62;

/// For the camera, lights and planes, which are not in the bounds that make the frame:
/// `p`, in scene coordinates. Throws InputError: "this <what> lies too far off ...".
void RequireInScene(Vec3d p, const SourceLocation& where, const char* what);

/// Leaves out the spheres, disks and instances that are too small or too flat.
void LeaveOutSmall(Placement& placement, std::vector<Note>& notes);

}  // namespace lanelight
