// Colours of spectra against published numbers: white points, black bodies, metals,
// glass. The oracle for metals is the tabulated CIE 1931 observer, independent of the
// analytic fit in the library.
#include "src/base/image/spectrum.h"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/image/spectrum_data.h"
#include "src/base/image/spectrum_integral.h"

namespace lanelight {
namespace {

// CIE 1931 2 degree observer and D65 at 380, 390, ..., 780 nm (ISO 11664-1, -2).
constexpr double kX[41] = {0.001368, 0.004243, 0.014310, 0.043510, 0.134380, 0.283900,
                           0.348280, 0.336200, 0.290800, 0.195360, 0.095640, 0.032010,
                           0.004900, 0.009300, 0.063270, 0.165500, 0.290400, 0.433450,
                           0.594500, 0.762100, 0.916300, 1.026300, 1.062200, 1.002600,
                           0.854450, 0.642400, 0.447900, 0.283500, 0.164900, 0.087400,
                           0.046770, 0.022700, 0.011359, 0.005790, 0.002899, 0.001440,
                           0.000690, 0.000332, 0.000166, 0.000083, 0.000042};
constexpr double kY[41] = {0.000039, 0.000120, 0.000396, 0.001210, 0.004000, 0.011600,
                           0.023000, 0.038000, 0.060000, 0.090980, 0.139020, 0.208020,
                           0.323000, 0.503000, 0.710000, 0.862000, 0.954000, 0.994950,
                           0.995000, 0.952000, 0.870000, 0.757000, 0.631000, 0.503000,
                           0.381000, 0.265000, 0.175000, 0.107000, 0.061000, 0.032000,
                           0.017000, 0.008210, 0.004102, 0.002091, 0.001047, 0.000520,
                           0.000249, 0.000120, 0.000060, 0.000030, 0.000015};
constexpr double kZ[41] = {0.006450, 0.020050, 0.067850, 0.207400, 0.645600, 1.385600,
                           1.747060, 1.772110, 1.669200, 1.287640, 0.812950, 0.465180,
                           0.272000, 0.158200, 0.078250, 0.042160, 0.020300, 0.008750,
                           0.003900, 0.002100, 0.001650, 0.001100, 0.000800, 0.000340,
                           0.000190, 0.000050, 0.000020, 0,        0,        0,
                           0,        0,        0,        0,        0,        0,
                           0,        0,        0,        0,        0};
constexpr double kD65[41] = {
    49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812,
    114.861, 115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046,
    100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992,
    80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856,
    75.0870, 63.5927, 46.4182, 66.8054, 63.3828};

template <class F>
Rgb TabulatedColor(F&& reflectance) {
  double x = 0, y = 0, z = 0, n = 0;
  for (int i = 0; i < 41; ++i) {
    const double light = kD65[i] * reflectance(380.0 + 10 * i);
    x += light * kX[i], y += light * kY[i], z += light * kZ[i], n += kD65[i] * kY[i];
  }
  x /= n, y /= n, z /= n;
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
          -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

double Reflectance(double eta, double k) {
  return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

Rgb NormalReflectance(const ComplexIor& ior) {
  return {Reflectance(ior.eta.x, ior.k.x), Reflectance(ior.eta.y, ior.k.y),
          Reflectance(ior.eta.z, ior.k.z)};
}

void CheckNearRgb(Rgb a, Rgb b, double margin) {
  INFO("(" << a.x << ", " << a.y << ", " << a.z << ") against (" << b.x << ", " << b.y
           << ", " << b.z << ")");
  CHECK(std::abs(a.x - b.x) <= margin);
  CHECK(std::abs(a.y - b.y) <= margin);
  CHECK(std::abs(a.z - b.z) <= margin);
}

const MetalTable& Table(const std::string& name) {
  for (const MetalTable& table : kMetals) {
    if (name == table.name) return table;
  }
  throw std::logic_error("no table of " + name);
}

}  // namespace

TEST_CASE("daylight follows the published D65", "[spectrum]") {
  const Spectrum d65 = DaylightD65();
  for (int i = 0; i < 41; ++i) {
    INFO(380 + 10 * i << " nm");
    CHECK(d65(380 + 10 * i) == Approx(kD65[i]).epsilon(0.001));
  }
}

TEST_CASE("white stays white in every color space", "[spectrum]") {
  Rgb rgb;
  REQUIRE(NamedSpectrum("stdillum-D65", SpectrumUse::kIlluminant, &rgb));
  CheckNearRgb(rgb, {1, 1, 1}, 1e-9);
  CheckNearRgb(RgbFromSamples({300, 900}, {0.25, 0.25}, SpectrumUse::kAlbedo),
               {0.25, 0.25, 0.25}, 1e-9);
  CheckNearRgb(RgbFromSamples({300, 900}, {3, 3}, SpectrumUse::kUnbounded), {3, 3, 3},
               1e-8);
  CheckNearRgb(RgbFromSamples({300, 900}, {3, 3}, SpectrumUse::kAlbedo), {1, 1, 1}, 0);
}

TEST_CASE("black bodies and illuminant A have their known colour", "[spectrum]") {
  // Linear sRGB of Planckian radiators, from their CIE 1931 chromaticity (x, y), Y = 1:
  // 2856 K (0.44757, 0.40745), 5000 K (0.3451, 0.3516), 6504 K near (0.3135, 0.3237).
  const auto from_xy = [](double x, double y) {
    const double X = x / y, Z = (1 - x - y) / y;
    return Rgb{3.2404542 * X - 1.5371385 - 0.4985314 * Z,
               -0.9692660 * X + 1.8760108 + 0.0415560 * Z,
               0.0556434 * X - 0.2040259 + 1.0572252 * Z};
  };
  CheckNearRgb(RgbFromBlackbody(2856), from_xy(0.44757, 0.40745), 0.03);
  CheckNearRgb(RgbFromBlackbody(5000), from_xy(0.3451, 0.3516), 0.02);
  CheckNearRgb(RgbFromBlackbody(6504), from_xy(0.3135, 0.3237), 0.02);
  Rgb a;
  REQUIRE(NamedSpectrum("stdillum-A", SpectrumUse::kIlluminant, &a));
  CheckNearRgb(a, RgbFromBlackbody(2856), 2e-3);
}

TEST_CASE("fluorescent lamps have the chromaticities that the CIE states", "[spectrum]") {
  // CIE 15:2004, table T.7: x and y of FL1 to FL12, 2 degree observer.
  constexpr double kChromaticity[12][2] = {
      {0.3131, 0.3371}, {0.3721, 0.3751}, {0.4091, 0.3941}, {0.4402, 0.4031},
      {0.3138, 0.3452}, {0.3779, 0.3882}, {0.3129, 0.3292}, {0.3458, 0.3586},
      {0.3741, 0.3727}, {0.3458, 0.3588}, {0.3805, 0.3769}, {0.4370, 0.4042}};
  for (int i = 0; i < 12; ++i) {
    const std::string name = fmt::format("stdillum-F{}", i + 1);
    Rgb rgb;
    INFO(name);
    REQUIRE(NamedSpectrum(name, SpectrumUse::kIlluminant, &rgb));
    const double x = 0.4124564 * rgb.x + 0.3575761 * rgb.y + 0.1804375 * rgb.z;
    const double y = 0.2126729 * rgb.x + 0.7151522 * rgb.y + 0.0721750 * rgb.z;
    const double z = 0.0193339 * rgb.x + 0.1191920 * rgb.y + 0.9503041 * rgb.z;
    // The observer is a fit, which narrow lines find out.
    CHECK(x / (x + y + z) == Approx(kChromaticity[i][0]).margin(0.004));
    CHECK(y / (x + y + z) == Approx(kChromaticity[i][1]).margin(0.004));
  }
}

TEST_CASE("light has luminance 1 and no negative channel at any temperature",
          "[spectrum]") {
  for (double kelvin : {0.5, 100.0, 800.0, 1500.0, 3000.0, 6500.0, 2e4, 1e7}) {
    const Rgb rgb = RgbFromBlackbody(kelvin);
    INFO(kelvin << " K: " << rgb.x << " " << rgb.y << " " << rgb.z);
    CHECK(Luminance(rgb) == Approx(1));
    CHECK((rgb.x >= 0 && rgb.y >= 0 && rgb.z >= 0));
  }
  CHECK(RgbFromBlackbody(1500).x > RgbFromBlackbody(3000).x);
  CHECK(RgbFromBlackbody(1e5).z > RgbFromBlackbody(6500).z);
}

TEST_CASE("metals reflect the integrated colour of their measured spectrum",
          "[spectrum]") {
  for (const std::string name : {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"}) {
    const MetalTable& table = Table(name);
    const Spectrum eta =
        EvenlySpaced({table.eta.begin(), table.eta.end()}, 380, 20, true);
    const Spectrum k = EvenlySpaced({table.k.begin(), table.k.end()}, 380, 20, true);
    const Rgb expected =
        TabulatedColor([&](double nm) { return Reflectance(eta(nm), k(nm)); });
    ComplexIor ior;
    REQUIRE(NamedMetal(name, &ior));
    INFO(name);
    CheckNearRgb(NormalReflectance(ior), Min(expected, Rgb{0.9995, 0.9995, 0.9995}),
                 0.012);
    for (int c = 0; c < 3; ++c) CHECK((ior.eta[c] > 0 && ior.k[c] >= 0));
  }
}

TEST_CASE("gold, silver and copper have their known colours", "[spectrum]") {
  ComplexIor ior;
  REQUIRE(NamedMetal("Au", &ior));
  CheckNearRgb(NormalReflectance(ior), {1.0, 0.77, 0.34}, 0.02);
  REQUIRE(NamedMetal("Ag", &ior));
  CheckNearRgb(NormalReflectance(ior), {0.97, 0.96, 0.915}, 0.01);
  REQUIRE(NamedMetal("Cu", &ior));
  CheckNearRgb(NormalReflectance(ior), {0.95, 0.64, 0.54}, 0.01);
  REQUIRE_FALSE(NamedMetal("Unobtainium", &ior));
}

TEST_CASE("a metal given by samples equals the named metal", "[spectrum]") {
  const MetalTable& gold = Table("Au");
  std::vector<double> nm(kMetalSamples);
  for (int i = 0; i < kMetalSamples; ++i) nm[i] = kMetalStart + kMetalStep * i;
  ComplexIor named;
  NamedMetal("Au", &named);
  const ComplexIor sampled = ComplexIorFromSamples(nm, {gold.eta.begin(), gold.eta.end()},
                                                   nm, {gold.k.begin(), gold.k.end()});
  CheckNearRgb(sampled.eta, named.eta, 1e-12);
  CheckNearRgb(sampled.k, named.k, 1e-12);
  // A dielectric: k stays 0.
  const ComplexIor glass = ComplexIorFromSamples({500}, {1.5}, {500}, {0});
  CheckNearRgb(glass.eta, {1.5, 1.5, 1.5}, 1e-9);
  CheckNearRgb(glass.k, {0, 0, 0}, 1e-6);
}

TEST_CASE("every listed spectrum can be loaded, others are refused", "[spectrum]") {
  const std::vector<std::string> names = NamedSpectra();
  CHECK(names.size() == 4 + 12 + 7 + 14);
  CHECK(std::is_sorted(names.begin(), names.end()));
  for (const std::string& name : names) {
    Rgb rgb;
    for (SpectrumUse use :
         {SpectrumUse::kAlbedo, SpectrumUse::kUnbounded, SpectrumUse::kIlluminant}) {
      if (name == "metal-MgO-k" && use == SpectrumUse::kIlluminant) continue;  // all zero
      CHECK(NamedSpectrum(name, use, &rgb));
    }
  }
  Rgb untouched{7, 8, 9};
  CHECK_FALSE(NamedSpectrum("metal-Au", SpectrumUse::kAlbedo, &untouched));
  CHECK(untouched == Rgb{7, 8, 9});
  double eta = 0;
  REQUIRE(NamedGlassEta("glass-BK7", &eta));
  CHECK(eta == Approx(1.5168));
  CHECK_FALSE(NamedGlassEta("glass-", &eta));
}

TEST_CASE("bad spectra are refused with a reason", "[spectrum]") {
  using Catch::Contains;
  const SpectrumUse use = SpectrumUse::kAlbedo;
  CHECK_THROWS_WITH(RgbFromSamples({}, {}, use), Contains("at least one"));
  CHECK_THROWS_WITH(RgbFromSamples({400, 500}, {1}, use),
                    Contains("2 wavelengths and 1"));
  CHECK_THROWS_WITH(RgbFromSamples({500, 500}, {1, 1}, use), Contains("must increase"));
  CHECK_THROWS_WITH(RgbFromSamples({500}, {NAN}, use), Contains("not finite"));
  CHECK_THROWS_WITH(RgbFromSamples({900, 950}, {1, 1}, SpectrumUse::kIlluminant),
                    Contains("between 360 and 830"));
}

TEST_CASE("colour spaces keep white and reach sRGB", "[spectrum]") {
  for (const std::string space : {"srgb", "dci-p3", "rec2020", "aces2065-1"}) {
    INFO(space);
    CheckNearRgb(ToSrgb(space, {0.5, 0.5, 0.5}, SpectrumUse::kAlbedo), {0.5, 0.5, 0.5},
                 1e-12);
  }
  // Rec. 2020 red in sRGB: (1.6605, -0.1246, -0.0182) (ITU-R BT.2407).
  CheckNearRgb(ToSrgb("rec2020", {1, 0, 0}, SpectrumUse::kAlbedo),
               {1.6605, -0.1246, -0.0182}, 2e-3);
  CheckNearRgb(ToSrgb("srgb", {0.1, 0.2, 0.3}, SpectrumUse::kAlbedo), {0.1, 0.2, 0.3}, 0);
  CHECK_THROWS_WITH(ToSrgb("cmyk", {}, SpectrumUse::kAlbedo), Catch::Contains("dci-p3"));
}

}  // namespace lanelight
