// The range of float32 in scene coordinates (frame.h), whose unit is about the size of
// the scene, or of the part that the camera sees up close.
//
// Kernels square distances and sizes. Squares of coordinates, and sums of three, must be
// below 2^128; squares of sizes must be normal numbers, at least 2^-126. Larger positions
// are refused. Smaller shapes are left out with a note, like degenerate triangles.
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
