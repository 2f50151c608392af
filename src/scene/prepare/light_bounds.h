// Where lights are and where they shine, as bounds: for trees of lights and for points in
// media around them.
#pragma once

#include "src/base/core/vec.h"
#include "src/scene/compiled/scene.h"

namespace lanelight {

/// Directions within an angle of an axis.
struct Cone {
  Vec3d axis{0, 0, 1};
  double angle = -1;  // half angle; below 0: empty; pi: all directions
};

/// Box around lights, cone around the normals they shine from, and their power.
struct LightBounds {
  Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  Cone cone;
  double power = 0;

  void Add(Vec3d p);
  /// Lights without power change nothing.
  void Add(const LightBounds& o);
  Vec3d Center() const { return 0.5 * (low + high); }
  /// Returns the area of the box's surface.
  double Area() const;
  /// Solid angle into which the lights shine, weighted by the cosine beyond the cone.
  double Orientation() const;
};

/// It is somewhere: no environment, no light from infinitely far away.
bool HasPlace(const LightRecord& light);

/// Of one light that has a place, in the scene; power 0.
LightBounds BoundsOf(const Geometry& geometry, const LightRecord& light);

}  // namespace lanelight
