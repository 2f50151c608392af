// Places the frame so that float32 resolves best what the camera sees up close.
//
// A coordinate is rounded in proportion to its distance from the frame's origin, and
// distant things look small. If sizes span more than kFocusRange, the frame's origin is
// placed near the camera. Spheres much larger than the camera's distance to them are
// compiled in a form that is exact near the camera (LargeSphereRecord in
// src/scene/geometry/geometry.h).
#pragma once

#include <vector>

#include "src/scene/compile/placement.h"

namespace lanelight {

/// Ratios of distances, as seen from the camera, up to which a scene is compiled about
/// the centre of its box, with all spheres in the ordinary form.
inline constexpr double kFocusRange = 64;

/// Point of a sphere that is nearest to `eye`, and its distance.
struct NearestPoint {
  Vec3d point;
  double distance = 0;
};
NearestPoint NearestPointOn(Vec3d center, double radius, Vec3d eye);

/// Needs `eye`. Moves the spheres to be compiled as LargeSphereRecords from `spheres` to
/// `large_spheres`: those whose surface is nearer to the eye than radius / kFocusRange.
/// Emitting ones stay, since light samples on them need the ordinary form.
void SeparateLargeSpheres(Placement& placement);

/// Appends a note about emitting spheres that are too large. From a radius of
/// kMaxEmitterRange times the camera's distance on, their surface is off by more than 1
/// % of that distance. Needs `eye`.
inline constexpr double kMaxEmitterRange = 4e4;
void NoteLargeEmitters(const Placement& placement, std::vector<Note>& notes);

/// Returns the frame of the scene; needs `eye` and `bounds`.
WorldFrame FocusFrame(const Placement& placement);

// The range of float32 in scene coordinates (world_frame.h), whose unit is about the size
// of the scene, or of the part that the camera sees up close.
//
// Kernels square distances and sizes. Squares of coordinates, and sums of three, must be
// below 2^128; squares of sizes must be normal numbers, at least 2^-126. Larger positions
// are refused. Smaller shapes are left out with a note, like degenerate triangles.

inline constexpr double kFarthestInScene = 0x1p62, kSmallestInScene = 0x1p-62;

/// Throws InputError if `p`, in scene coordinates, is out of range. For the camera,
/// lights and planes, which do not count for the frame.
void RequireInScene(Vec3d p, const SourceLocation& where, const char* what);

/// Removes the spheres, disks and instances that are too small or too flat.
void DropTooSmallShapes(Placement& placement, std::vector<Note>& notes);

}  // namespace lanelight
