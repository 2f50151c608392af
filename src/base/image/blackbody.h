// Light of hot bodies in the scale of pbrt-v4's media with temperatures.
#pragma once

#include <vector>

#include "src/base/core/vec.h"
#include "src/base/image/spectrum_integral.h"

namespace lanelight {

/// The spectrum of a black body divided by its own maximum. `kelvin` as below.
Spectrum NormalizedBlackbody(double kelvin);

/// Linear sRGB of a black body whose spectrum is divided by its own maximum, as pbrt-v4's
/// film sees it: its luminance is the integral over nm of that spectrum times the
/// photometric curve, so at most 106.9, and nearly 0 where all is infrared. Channels
/// below 0 are cut, and the luminance kept. `kelvin` must be positive and finite
/// (LL_CHECK).
Rgb RgbOfBlackbody(double kelvin);

/// The integral over nm of the photometric curve of the CIE 1931 observer: what pbrt-v4's
/// film makes of `rgb` illuminants of (1, 1, 1) that nothing normalises.
inline constexpr double kPhotometricIntegral = 106.856895;

/// Returns, per wavelength bin, the value of a spectrum of 1 (a black body at its
/// maximum) in units of D65, in the scale of RgbOfBlackbody.
std::vector<float> UnitsOfBlackbody();

}  // namespace lanelight
