// Fluxes through dielectric coats, and the colours of what lies below them.
#pragma once

#include <array>
#include <vector>

#include "src/base/core/vec.h"
#include "src/base/image/spectrum_integral.h"
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

/// Returns the fluxes of a GGX interface of roughness `alpha` (below 1e-3: smooth;
/// anisotropic interfaces: sqrt(ax ay)) and index `eta` > 0 relative to the outside, over
/// a medium that absorbs exp(-thickness / cos) per crossing (pbrt-v4's coats, whose
/// medium has unit extinction). Both include the losses of single-scattering GGX: light
/// scattered to the wrong side and masked light is gone. Quadrature in double precision,
/// absolute error below 2e-3 (smooth: 1e-6). Throws CheckFailure for values out of range.
CoatTable ComputeCoatTable(double alpha, double eta, double thickness);

// Colour of the base of a coat. Light bounces between base and coat, so what leaves is a
// series in the reflectance, not proportional to it; a renderer that carries spectra sees
// the mean of the series over wavelengths, not the series of the mean. Constant colours
// are corrected when they are compiled (material_row.cc), textured ones by a table
// (CoatFits).

/// Returns rho (1 + x + ... + x^(bounces-1)), x = rho * internal: the reflected fraction
/// of the light that reaches a coated base. rho and internal are in [0, 1].
double CoatedResponse(double rho, double internal, int bounces);

/// Returns the RGB reflectance whose response per channel equals the colour, under D65,
/// of the response of the spectrum of `rgb`. Equal to `rgb` for greys, and for one
/// bounce.
Rgb EffectiveCoatBase(Rgb rgb, double internal, int bounces);
/// The same with the spectrum of `rgb` (ReflectanceOfRgb), for a colour that is no grey.
Rgb EffectiveCoatBase(Rgb rgb, const Spectrum& base, double internal, int bounces);

/// Makes tables of kCoatFitNodes nodes per channel: EffectiveCoatBase(rgb) - rgb, three
/// floats for each node of a grid over [0, 1]^3, red fastest. Interpolated between the
/// four corners of a tetrahedron around the diagonal (kernels/texture/coated_base-inl.h),
/// it leaves greys as they are; off the nodes it is 0.005 off in the mean square, at most
/// 0.06, where the correction itself is 0.023 and 0.14. The spectra of the nodes are
/// found once, with the first table.
class CoatFits {
 public:
  /// Returns the table of a coat with this internal reflectance and `bounces` off the
  /// base, both in range for EffectiveCoatBase.
  std::vector<float> Table(double internal, int bounces);

 private:
  std::vector<Spectrum> bases_;
};

}  // namespace lanelight
