// Material of the scene description to LocalMaterial: mixes resolved, textures looked up.
#pragma once

#include "tests/reference/bsdf.h"
#include "tests/reference/geometry.h"

namespace lanelight::reference {

/// The material at a surface point. A mix is resolved at random with its weight.
LocalMaterial EvaluateMaterial(const SceneDescription& scene, Index material,
                               const SurfacePoint& at, const TextureLookup& texture,
                               Random& random);

/// Makes microfacets with alpha below 0.3 rougher (Integrator::regularize).
void Regularize(LocalMaterial& material);

/// A diffuse material whose reflectance has the mean of the albedo for `wo`.
LocalMaterial MadeDiffuse(const LocalMaterial& material, Vec3d wo, Random& random);

}  // namespace lanelight::reference
