// The colour spaces of pbrt-v4, and white balance.
#pragma once

#include <string>

#include "src/base/image/color_matrix.h"

namespace lanelight {

struct ColorSpace {
  const char* name;
  Chromaticity red, green, blue, white;
};

/// "srgb", "dci-p3" (its primaries, white D65), "rec2020" (ITU-R BT.2020) or "aces2065-1"
/// (SMPTE ST 2065-1). InputError that lists the names otherwise.
const ColorSpace& FindColorSpace(const std::string& name);

/// XYZ of its linear rgb; (1, 1, 1) is its white, with Y = 1.
ColorMatrix XyzFrom(const ColorSpace& space);

/// Linear sRGB of a space's linear rgb, both as light: colours stay what they are, so a
/// white other than D65 is not (1, 1, 1). Not clamped.
ColorMatrix SrgbFrom(const ColorSpace& space);

/// Of the daylight of this temperature (CIE 15:2004, 4000 to 25000 K), and below of a
/// black body, as pbrt-v4.
Chromaticity WhiteOfTemperature(double kelvin);
inline constexpr double kLeastWhiteKelvin = 2000, kMostWhiteKelvin = 25000;

/// XYZ under one white to XYZ that looks alike under another, by the Bradford transform
/// (Lam 1985; ICC.1:2010, annex E).
ColorMatrix Bradford(Chromaticity from, Chromaticity to);

/// Linear sRGB to what a film of this space holds whose white balance makes light of this
/// temperature the space's white; 0: colours stay what they are.
ColorMatrix FilmMatrix(const ColorSpace& space, double white_kelvin);

}  // namespace lanelight
