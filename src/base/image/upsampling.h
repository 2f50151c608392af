// Spectra for colours that paths carry by wavelength: sigmoids of quadratic polynomials
// (Jakob and Hanika 2019, "A Low-Dimensional Function Space for Efficient Spectral
// Upsampling"), fitted so that their colour under D65 is the one asked for.
#pragma once

#include <array>
#include <vector>

#include "src/base/image/spectrum_integral.h"
#include "src/base/image/wavelengths.h"

namespace lanelight {

/// Argument of the polynomials: -1 to 1 over the wavelengths that are carried.
constexpr double SigmoidPlace(double nm) {
  constexpr double kMiddle = (kFirstCarriedNm + kLastCarriedNm) / 2.0;
  return (nm - kMiddle) / (kLastCarriedNm - kMiddle);
}

/// 1/2 + p / (2 sqrt(1 + p^2)), p = (c[0] t + c[1]) t + c[2], t the place.
struct SigmoidSpectrum {
  std::array<double, 3> c{};

  double operator()(double nm) const;
};

/// Of a reflectance, its channels in [0, 1]: exact but for 3e-4 of the most saturated
/// colours. Greys are constant. `near`, if not null: of a colour like it, to begin with.
SigmoidSpectrum FitSigmoid(Rgb rgb, const SigmoidSpectrum* near = nullptr);

/// The same, with greys constant to the last bit.
Spectrum UpsampledReflectance(Rgb rgb);
/// Of a colour without bound, no channel below 0: a factor times a reflectance whose
/// largest channel is 1/2, as pbrt-v4 has lights.
Spectrum UpsampledColor(Rgb rgb);

/// Table for colours that are known while rendering: nodes of a cube, red fastest, with
/// HalfTangent(p) at kUpsamplingNm. Coordinates are those of channels v kept
/// kMinUpsampled from 0 and 1: the half tangent of the p that a grey v has, scaled to
/// [0, kUpsamplingNodes - 1]. Between nodes it is linear in each tetrahedron, so that
/// greys stay what they are; the colour of others is met within 1e-3 in the mean over the
/// cube.
inline constexpr std::array<double, 3> kUpsamplingNm = {450, 545, 610};
const std::vector<float>& UpsamplingTable();  // made once

/// The sigmoid of a reflectance by that table, as kernels look it up.
SigmoidSpectrum SigmoidByTable(Rgb rgb);

/// tan(a / 2) of p = tan(a): in (-1, 1).
double HalfTangent(double p);
/// Returns p of a grey from x = 2 v - 1 = sin(a).
double HalfTangentOfGrey(double v);

/// The polynomial through values at kUpsamplingNm: c[k] is the sum of row k times them.
std::array<std::array<double, 3>, 3> PolynomialThrough();

/// Fits the sigmoid of a quadratic in the wavelength whose colour under D65 is closest to
/// `rgb` (each in [0, 1]), by damped least squares. Greys are constant spectra. Source:
/// Jakob and Hanika 2019, "A Low-Dimensional Function Space for Efficient Spectral
/// Upsampling".
Spectrum ReflectanceOfRgb(Rgb rgb);

}  // namespace lanelight
