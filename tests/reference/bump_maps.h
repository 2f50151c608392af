// Shading normals of displacement textures and normal maps in the reference tracer.
#pragma once

#include "tests/reference/geometry.h"

namespace lanelight::reference {

/// Value of a normal map, the texel as it is in the file (0..1), at (u, v).
using NormalMapLookup = std::function<Rgb(const std::string& path, double u, double v)>;

/// The steps that measure the slopes of a displacement texture.
struct UvSteps {
  double u = 0.0005, v = 0.0005;
};

/// Half of a pixel's footprint at a surface point that lies before the camera, in surface
/// coordinates.
UvSteps HalfFootprint(const SceneDescription& scene, const SurfacePoint& at);

/// The surface with the shading normal and tangent that its material (no mix) gives it.
/// `wo`: unit, to where the path came from.
SurfacePoint WithBumpMaps(const SceneDescription& scene, const Material& material,
                          const SurfacePoint& at, Vec3d wo, const TextureLookup& texture,
                          const NormalMapLookup& normal_map);

}  // namespace lanelight::reference
