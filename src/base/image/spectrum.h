// Spectra to linear sRGB, once, while a scene is read: what pbrt-v4's spectral rendering
// would show on an `rgb` film with the XYZ sensor.
//
// Colour matching functions: the CIE 1931 observer in the analytic fit of Wyman, Sloan
// and Shirley 2013 ("Simple Analytic Approximations to the CIE XYZ Color Matching
// Functions", JCGT 2(2), equation 4). Each sRGB channel is rescaled by the fit's own
// response to D65, so that D65 is exactly (1, 1, 1) and a grey reflectance stays grey.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/base/core/vec.h"
#include "src/base/image/spectrum_integral.h"

namespace lanelight {

/// The quantity that a spectrum describes, which decides how it becomes three numbers.
/// kAlbedo: a reflectance; its colour under D65, clamped to [0, 1]. kUnbounded: an index
/// of refraction or similar; the same without the upper clamp. kIlluminant: emission; its
/// colour, scaled to luminance Y = 1. kRadiance: the same unscaled; a constant spectrum
/// of 1 has luminance 1. Named illuminants and a black body's maximum are 1 as well, as
/// in pbrt. Negative channels (colours outside sRGB) are cut to 0 before scaling.
enum class SpectrumUse { kAlbedo, kUnbounded, kIlluminant, kRadiance };

/// Colour of a black body, linear sRGB with Y = 1. `kelvin` must be positive and finite
/// (LL_CHECK; the parser refuses other values first).
Rgb RgbFromBlackbody(double kelvin);

/// Piecewise linear spectrum through the samples, zero outside them (as pbrt).
/// Wavelengths in nm, strictly increasing; at least one sample, equal counts, all finite,
/// else InputError. An illuminant without light in 360..830 nm is an InputError as well.
Rgb RgbFromSamples(const std::vector<double>& wavelengths_nm,
                   const std::vector<double>& values, SpectrumUse use);

/// A spectrum of pbrt by its name, e.g. "metal-Cu-eta", "glass-BK7", "stdillum-D65".
/// Returns false and leaves `rgb` alone if the name is not one of NamedSpectra().
bool NamedSpectrum(const std::string& name, SpectrumUse use, Rgb* rgb);

/// The spectrum itself: of light in any unit, of glass by its dispersion formula.
std::optional<Spectrum> SpectrumOfName(const std::string& name);
/// Three numbers for a spectrum, by its use.
Rgb RgbFromSpectrum(const Spectrum& spectrum, SpectrumUse use);
/// Of a black body, in any unit; `kelvin` as below.
Spectrum BlackbodySpectrum(double kelvin);
/// Through samples, with the rules of RgbFromSamples; `extend`: outside them it keeps its
/// end values, else it is zero.
Spectrum SpectrumFromSamples(const std::vector<double>& wavelengths_nm,
                             const std::vector<double>& values, bool extend);

/// All names that NamedSpectrum knows, sorted.
std::vector<std::string> NamedSpectra();

/// Complex index of refraction eta + i k per channel.
struct ComplexIor {
  Rgb eta, k;
};

/// "Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2", as in pbrt-v4. The normal-incidence
/// reflectance of each channel equals that of the measured spectrum under D65 (clamped to
/// below 1), which is what decides the colour of a metal; eta is the sensitivity-weighted
/// mean and k is solved for. False if the name is unknown.
bool NamedMetal(const std::string& metal, ComplexIor* ior);

/// The same for spectra from a file: eta(lambda) and k(lambda) as sample lists, with the
/// rules of RgbFromSamples; outside its samples a spectrum keeps its end value here.
ComplexIor ComplexIorFromSamples(const std::vector<double>& eta_nm,
                                 const std::vector<double>& eta,
                                 const std::vector<double>& k_nm,
                                 const std::vector<double>& k);

/// Catalogue index of refraction at 587.6 nm (the d line) of "glass-BK7", "glass-BAF10",
/// "glass-FK51A", "glass-LASF9", "glass-F5" (Schott SF5), "glass-F10" (SF10), "glass-F11"
/// (SF11). False if the name is unknown.
bool NamedGlassEta(const std::string& name, double* eta);

/// Converts a linear colour of a pbrt colour space ("srgb", "dci-p3", "rec2020",
/// "aces2065-1") to linear sRGB; throws InputError that lists the names otherwise. Light
/// keeps its colour; of anything else the space's white becomes (1, 1, 1), because a
/// white reflectance is white in any light. Colours outside sRGB have channels below 0
/// (above 1 only beside one below 0).
Rgb ToSrgb(const std::string& color_space, Rgb color, SpectrumUse use);

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
