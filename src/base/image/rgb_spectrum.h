// A smooth reflectance spectrum for an RGB colour, for the few places where colour does
// not act linearly and an RGB renderer would differ from a spectral one.
#pragma once

#include "src/base/image/spectrum_integral.h"

namespace lanelight {

/// Sigmoid of a quadratic polynomial in the wavelength whose colour under D65 is `rgb`
/// (each in [0, 1]) as nearly as such a spectrum can be (Jakob and Hanika 2019, "A
/// Low-Dimensional Function Space for Efficient Spectral Upsampling"), fitted by damped
/// least squares. Greys are constant spectra.
Spectrum ReflectanceOfRgb(Rgb rgb);

}  // namespace lanelight
