// Integrals of spectra against the eye, for spectrum.cc and its neighbours.
#pragma once

#include <functional>
#include <vector>

#include "src/base/core/spectral_constants.h"
#include "src/base/core/vec.h"

namespace lanelight {

using Spectrum = std::function<double(double wavelength_nm)>;

/// CIE daylight of the given chromaticity, relative, zero outside 380..780 nm (CIE
/// 15:2004).
Spectrum Daylight(double x, double y);
/// The standard illuminant D65, by the daylight locus at 6504 K. (The rounded
/// chromaticity of the sRGB white would change the blue end by half a percent.)
Spectrum DaylightD65();

/// Linear interpolation in evenly spaced samples. Outside: the end value if `extend`, or
/// 0.
Spectrum EvenlySpaced(std::vector<double> samples, double first_nm, double step_nm,
                      bool extend);

/// Linear interpolation between (nm[i], values[i]), nm increasing.
Spectrum Interpolated(std::vector<double> nm, std::vector<double> values, bool extend);

/// What each channel of linear sRGB has of D65 per nm, by tables of the CIE: 1 in all.
/// Nothing outside 380 to 780 nm.
Rgb WhiteFraction(double nm);

/// Colour of a reflectance under D65; 1 becomes exactly (1, 1, 1). Not clamped.
Rgb ColorUnderD65(const Spectrum& reflectance);

/// Colour of light: D65 becomes a multiple of (1, 1, 1). Not normalised, not clamped.
Rgb ColorOfLight(const Spectrum& light);

/// Mean per channel, weighted by D65 times the positive part of the sensitivity of that
/// sRGB channel, so it lies between the smallest and the largest value of the spectrum.
Rgb SensitivityMean(const Spectrum& spectrum);

}  // namespace lanelight
