// Fluxes through a dielectric coat, tabulated when a scene is compiled. Above a
// Lambertian base nothing else of the coat matters: the base forgets directions.
#pragma once

#include <array>

#include "src/scene/compiled/scene.h"

namespace lanelight {

struct CoatTable {
  /// Fraction of the light arriving from outside at mu = i / (kCoatTableSize - 1) that
  /// reaches the base. Its lobe may be any; radiance scaling is not included.
  std::array<float, kCoatTableSize> transmittance{};
  /// Fraction of the light leaving the base (cosine-distributed) that the interface sends
  /// back to the base.
  float internal_reflectance = 0;
};

/// Fluxes of a GGX interface of roughness `alpha` (below 1e-3: smooth; anisotropic
/// interfaces: sqrt(ax ay)) and index `eta` > 0 relative to the outside, over a medium
/// that absorbs exp(-thickness / cos) per crossing (pbrt-v4's coats, whose medium has
/// unit extinction). Both include the losses of single-scattering GGX: light scattered to
/// the wrong side and masked light is gone. Quadrature in double precision, absolute
/// error below 2e-3 (smooth: 1e-6). Throws CheckFailure for values out of range.
CoatTable ComputeCoatTable(double alpha, double eta, double thickness);

}  // namespace lanelight
