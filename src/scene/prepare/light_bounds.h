// Bounds of lights: where they are and where they shine; and a binary tree over them, for
// light-selection=tree.
#pragma once

#include <span>

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
  /// Returns the solid angle of emission, weighted by the cosine beyond the cone.
  double Orientation() const;
};

/// Returns false for environments and lights at infinity.
bool HasPlace(const LightRecord& light);

/// Returns the bounds of a light that has a place, in scene space, with power 0.
LightBounds BoundsOf(const Geometry& geometry, const LightRecord& light);

/// Tree over the lights of positive weight. Splits minimise the cost of Conty Estevez and
/// Kulla 2018: power times bounded area times a measure of the cone of normals.
LightTree BuildLightTree(const Geometry& geometry, std::span<const LightRecord> lights,
                         std::span<const double> weights);

}  // namespace lanelight
