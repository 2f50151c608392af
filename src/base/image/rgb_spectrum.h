// A smooth reflectance spectrum for an RGB colour, for the few places where colour does
// not act linearly and an RGB renderer would differ from a spectral one.
#pragma once

#include "src/base/image/spectrum_integral.h"

namespace lanelight {

/// Fits the sigmoid of a quadratic in the wavelength whose colour under D65 is closest to
/// `rgb` (each in [0, 1]) by damped least squares (Jakob and Hanika 2019, "A
/// Low-Dimensional Function Space for Efficient Spectral Upsampling"). Greys are constant
/// spectra.
Spectrum ReflectanceOfRgb(Rgb rgb);

}  // namespace lanelight
