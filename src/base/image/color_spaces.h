// Colour spaces of pbrt-v4, white balance, and the colour response of films.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "src/base/core/vec.h"

namespace lanelight {

struct Chromaticity {
  double x, y;
  constexpr Vec3d Xyz() const { return {x / y, 1, (1 - x - y) / y}; }  // with Y = 1
};

inline constexpr Chromaticity kD65White = {0.3127, 0.3290};

struct ColorMatrix {
  Vec3d row[3];

  Vec3d operator*(Vec3d v) const {
    return {Dot(row[0], v), Dot(row[1], v), Dot(row[2], v)};
  }
};

/// Inverse by cofactors; the matrices here are far from singular.
inline ColorMatrix Inverse(const ColorMatrix& m) {
  const Vec3d c0 = Cross(m.row[1], m.row[2]), c1 = Cross(m.row[2], m.row[0]),
              c2 = Cross(m.row[0], m.row[1]);
  const double d = 1 / Dot(m.row[0], c0);
  return {{Vec3d{c0.x, c1.x, c2.x} * d, Vec3d{c0.y, c1.y, c2.y} * d,
           Vec3d{c0.z, c1.z, c2.z} * d}};
}

/// XYZ of linear rgb whose primaries are r, g, b and whose (1, 1, 1) is white with Y = 1
/// (SMPTE RP 177-1993).
inline ColorMatrix XyzFromPrimaries(Chromaticity r, Chromaticity g, Chromaticity b,
                                    Chromaticity white) {
  const Vec3d R = r.Xyz(), G = g.Xyz(), B = b.Xyz();
  const ColorMatrix primaries = {{{R.x, G.x, B.x}, {R.y, G.y, B.y}, {R.z, G.z, B.z}}};
  const Vec3d s = Inverse(primaries) * white.Xyz();
  return {{{R.x * s.x, G.x * s.y, B.x * s.z},
           {R.y * s.x, G.y * s.y, B.y * s.z},
           {R.z * s.x, G.z * s.y, B.z * s.z}}};
}

inline ColorMatrix XyzFromSrgb() {
  return XyzFromPrimaries({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65White);
}

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
inline constexpr double kMinWhiteKelvin = 2000, kMaxWhiteKelvin = 25000;

/// XYZ under one white to XYZ that looks alike under another, by the Bradford transform
/// (Lam 1985; ICC.1:2010, annex E).
ColorMatrix Bradford(Chromaticity from, Chromaticity to);

/// Linear sRGB to what a film of this space holds whose white balance makes light of this
/// temperature the space's white; 0: colours stay what they are.
ColorMatrix FilmMatrix(const ColorSpace& space, double white_kelvin);

struct FilmResponse {
  /// From linear sRGB to what the image holds.
  ColorMatrix matrix = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  /// Most that X, Y or Z of a sample may be, the exposure included; larger ones are
  /// scaled down, which darkens the image: it is biased, as in pbrt-v4.
  double max_component = std::numeric_limits<double>::infinity();

  bool limits() const { return max_component < std::numeric_limits<double>::infinity(); }
  bool IsIdentity() const;
};

/// Planes of linear sRGB, changed in place.
struct ColorPlanes {
  float *r, *g, *b;
};
/// Scales down colours with a component above the limit.
void LimitColors(const FilmResponse& response, const ColorPlanes& planes,
                 std::size_t count);
/// Multiplies all colours by the matrix.
void ConvertColors(const FilmResponse& response, const ColorPlanes& planes,
                   std::size_t count);

}  // namespace lanelight
