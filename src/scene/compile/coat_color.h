// Colour of the base of a coat. Light bounces between base and coat, so what leaves is a
// series in the reflectance, not proportional to it; a renderer that carries spectra sees
// the mean of the series over wavelengths, not the series of the mean. Constant colours
// are corrected when they are compiled (material_row.cc), textured ones by a table
// (coat_fit.h).
#pragma once

#include "src/base/core/vec.h"
#include "src/base/image/spectrum_integral.h"

namespace lanelight {

/// rho (1 + x + ... + x^(bounces-1)), x = rho * internal: what a coated base returns per
/// unit of light that reaches it. rho and internal in [0, 1].
double CoatedResponse(double rho, double internal, int bounces);

/// RGB reflectance whose response per channel equals the colour, under D65, of the
/// response of the spectrum of `rgb`. Equal to `rgb` for greys, and for one bounce.
Rgb EffectiveCoatBase(Rgb rgb, double internal, int bounces);
/// The same with the spectrum of `rgb` (ReflectanceOfRgb), for a colour that is no grey.
Rgb EffectiveCoatBase(Rgb rgb, const Spectrum& base, double internal, int bounces);

}  // namespace lanelight
