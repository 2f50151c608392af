// Smooth stand-ins for environments, for control=ambient.
#pragma once

#include <cstdint>
#include <vector>

#include "src/prepare/prepared_scene.h"

namespace lanelight {

/// A quadratic polynomial on the unit sphere, a sum of spherical harmonics of degree 2:
/// coefficients of 1, x, y, z, xy, yz, zx, z^2, x^2 - y^2.
struct Quadratic {
  float c[9] = {};
  double operator()(Vec3d d) const;
};

/// What the control variate takes an infinite light for: radiance by direction and the
/// irradiance that this radiance gives a surface, by its normal.
struct AmbientLight {
  std::uint32_t light = 0;  // index into LightTable::lights
  Quadratic radiance[3], irradiance[3];
};

/// Light samples find every direction. An image has directions of probability 0 where it
/// is black or next to black.
bool SamplesEveryDirection(const EnvironmentTable& table);

/// For each of LightTable::infinite, in that order: constant environments as they are,
/// images projected to spherical harmonics of degree 2, in double. With directions=light
/// an image that light samples do not find all of is replaced by 0.
std::vector<AmbientLight> MakeAmbientLights(const PreparedScene& scene);

}  // namespace lanelight
