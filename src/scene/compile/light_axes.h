// The axes of lights under their transform, which may be any invertible one.
#pragma once

#include <vector>

#include "src/base/core/vec.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// The linear part of the way from the scene to the light. Throws InputError at the light
/// if there is none in float32.
Transform LightFromScene(const Light& light);

/// Sets axes of `image` so that dot(x_axis, w) is dot(x, LightFromScene(w)), and so on.
struct LightAxes {
  Vec3d x, y, z;
};
void StoreAxes(const Light& light, const LightAxes& axes, LightImage& image);

/// A cone in the scene that holds directions of the light.
struct LightCone {
  Vec3d axis;          // unit
  double versine = 0;  // 1 - cos of its angle
};

/// The cone about the image of `axis` that holds those of `edge`, the rays along the edge
/// of a convex cone.
LightCone ConeAround(const Light& light, Vec3d axis, const std::vector<Vec3d>& edge);

/// The cone about the image of the unit vector `axis` that holds all at most `degrees`
/// from it.
LightCone StretchedCone(const Light& light, Vec3d axis, double degrees);

}  // namespace lanelight
