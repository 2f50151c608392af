// Color spaces, white balance, and what a film makes of samples.
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>

#include <catch2/catch.hpp>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/image/color_spaces.h"
#include "src/base/image/exr.h"
#include "src/base/image/spectrum.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

void CheckNear(Vec3d a, Vec3d b, double tolerance) {
  CHECK(a.x == Approx(b.x).margin(tolerance));
  CHECK(a.y == Approx(b.y).margin(tolerance));
  CHECK(a.z == Approx(b.z).margin(tolerance));
}

constexpr const char* kNames[] = {"srgb", "dci-p3", "rec2020", "aces2065-1"};

TEST_CASE("color spaces: matrices equal the published ones", "[film]") {
  // ITU-R BT.2087-0: BT.709 to BT.2020.
  const ColorMatrix rec2020 = FilmMatrix(FindColorSpace("rec2020"), 0);
  CheckNear(rec2020.row[0], {0.6274, 0.3293, 0.0433}, 1e-4);
  CheckNear(rec2020.row[1], {0.0691, 0.9195, 0.0114}, 1e-4);
  CheckNear(rec2020.row[2], {0.0164, 0.0880, 0.8956}, 1e-4);
  // SMPTE ST 2065-1: its table of XYZ from ACES.
  const ColorMatrix aces = XyzFrom(FindColorSpace("aces2065-1"));
  CheckNear(aces.row[0], {0.9525523959, 0, 0.0000936786}, 1e-6);
  CheckNear(aces.row[1], {0.3439664498, 0.7281660966, -0.0721325464}, 1e-6);
  CheckNear(aces.row[2], {0, 0, 1.0088251844}, 1e-6);
  CHECK_THROWS_WITH(FindColorSpace("cmyk"), Catch::Contains("dci-p3"));
}

TEST_CASE("color spaces: film values are in the film's color space", "[film]") {
  const Rgb color = {0.2, 0.7, 0.4};
  for (const char* name : kNames) {
    const ColorSpace& space = FindColorSpace(name);
    CheckNear(SrgbFrom(space) * (FilmMatrix(space, 0) * color), color, 1e-9);
    // Light of a space comes back on a film of that space.
    CheckNear(FilmMatrix(space, 0) * ToSrgb(name, color, SpectrumUse::kIlluminant), color,
              1e-9);
    // A white reflectance is white in all of them.
    CheckNear(ToSrgb(name, {1, 1, 1}, SpectrumUse::kAlbedo), {1, 1, 1}, 1e-9);
  }
}

TEST_CASE("white balance: whites by temperature", "[film]") {
  // Illuminants D65, D50 and D75 (CIE 15:2004), and A, a black body of 2856 K; pbrt's
  // temperatures of daylight are those of today's constant.
  CHECK(WhiteOfTemperature(6500).x == Approx(0.3127).margin(1e-4));
  CHECK(WhiteOfTemperature(6500).y == Approx(0.3291).margin(2e-4));
  CHECK(WhiteOfTemperature(5000).x == Approx(0.3457).margin(1e-4));
  CHECK(WhiteOfTemperature(5000).y == Approx(0.3586).margin(2e-4));
  CHECK(WhiteOfTemperature(2856).x == Approx(0.4476).margin(2e-3));
  CHECK(WhiteOfTemperature(2856).y == Approx(0.4074).margin(2e-3));
  CHECK(WhiteOfTemperature(7500).x == Approx(0.2990).margin(1e-4));
  CHECK(WhiteOfTemperature(7500).y == Approx(0.3149).margin(2e-4));
}

TEST_CASE("white balance: the Bradford transform", "[film]") {
  // D65 to D50, as Lindbloom has it.
  const ColorMatrix m = Bradford({0.31271, 0.32902}, {0.34567, 0.35850});
  CheckNear(m.row[0], {1.0478, 0.0229, -0.0501}, 3e-4);
  CheckNear(m.row[1], {0.0295, 0.9905, -0.0170}, 3e-4);
  CheckNear(m.row[2], {-0.0092, 0.0150, 0.7521}, 3e-4);
  // The light of the balance's temperature becomes the space's white, as bright as it
  // was.
  for (const char* name : kNames) {
    const Rgb light = Inverse(XyzFromSrgb()) * WhiteOfTemperature(5200).Xyz();
    CheckNear(FilmMatrix(FindColorSpace(name), 5200) * light, {1, 1, 1}, 1e-9);
  }
  CHECK(FilmResponse{FilmMatrix(FindColorSpace("srgb"), 0)}.IsIdentity());
}

TEST_CASE("film response: samples are limited in XYZ, then converted", "[film]") {
  FilmResponse response;
  response.max_component = 2;
  CHECK_FALSE(response.IsIdentity());
  std::vector<float> r = {4, 1, 0}, g = {4, 1, 0}, b = {4, 1, 0};
  LimitColors(response, {r.data(), g.data(), b.data()}, 3);
  // White of 4 has Z = 4 (1 - x - y) / y of D65.
  const double z = (1 - 0.3127 - 0.3290) / 0.3290;
  CHECK(r[0] == Approx(2 / z).epsilon(1e-6));
  CHECK(b[0] == r[0]);
  CHECK(r[1] == 1);
  CHECK(r[2] == 0);
  response.matrix = {{{0, 1, 0}, {0, 0, 1}, {2, 0, 0}}};
  r = {1}, g = {2}, b = {3};
  ConvertColors(response, {r.data(), g.data(), b.data()}, 1);
  CHECK(r[0] == 2);
  CHECK(g[0] == 3);
  CHECK(b[0] == 2);
}

TEST_CASE("EXR: color spaces other than sRGB are stored as chromaticities", "[film]") {
  const TemporaryFolder folder;
  const std::vector<ExrPlane> planes = {{"R", {1}}, {"G", {1}}, {"B", {1}}};
  ExrOptions options;
  WriteExr(folder.File("plain.exr"), 1, 1, planes, options);
  CHECK_FALSE(
      Imf::hasChromaticities(Imf::InputFile(folder.File("plain.exr").c_str()).header()));
  options.color_space = "rec2020";
  WriteExr(folder.File("wide.exr"), 1, 1, planes, options);
  const Imf::InputFile file(folder.File("wide.exr").c_str());
  REQUIRE(Imf::hasChromaticities(file.header()));
  const Imf::Chromaticities c = Imf::chromaticities(file.header());
  CHECK(c.red.x == Approx(0.708));
  CHECK(c.green.y == Approx(0.797));
  CHECK(c.white.x == Approx(0.3127));
}

}  // namespace
}  // namespace lanelight
