// Lights and the spectra of their emission.
#include <catch2/catch.hpp>

#include "src/base/core/pi.h"
#include "src/base/image/spectrum.h"
#include "tests/scene/parse/parse_text.h"

namespace lanelight {
namespace {

Light ParseLight(const std::string& text) {
  return ParseWorld("LightSource " + text).lights.back();
}

void CheckColor(Rgb found, Rgb expected) {
  CHECK(found.x == Approx(expected.x));
  CHECK(found.y == Approx(expected.y));
  CHECK(found.z == Approx(expected.z));
}

TEST_CASE("point lights", "[parse]") {
  const SceneDescription scene = ParseWorld(
      "Translate 1 2 3 LightSource \"point\" \"rgb I\" [ 1 2 3 ] \"float scale\" 2 "
      "\"point3 from\" [ 1 0 0 ]");
  CHECK(scene.lights[0].kind == LightKind::kPoint);
  CheckColor(scene.lights[0].emission, {2, 4, 6});
  CHECK(scene.lights[0].from.x == 1);
  CHECK(scene.lights[0].world_from_light.Point({0, 0, 0}).z == 3);
  CheckColor(ParseLight("\"point\"").emission, {1, 1, 1});
  // Power P over the whole sphere of directions.
  CheckColor(ParseLight("\"point\" \"float power\" 100").emission,
             Rgb{1, 1, 1} * (100 / (4 * kPi)));
}

TEST_CASE("spot lights", "[parse]") {
  const Light plain = ParseLight(
      "\"spot\" \"point3 from\" [ 0 0 1 ] \"point3 to\" [ 0 0 0 ] \"rgb I\" [ 5 5 5 ] "
      "\"float coneangle\" 40 \"float conedeltaangle\" 10");
  CHECK(plain.kind == LightKind::kSpot);
  CHECK(plain.cone_angle == 40);
  CHECK(plain.cone_delta == 10);
  CheckColor(plain.emission, {5, 5, 5});
  // Without a soft edge, power / solid angle of the cone.
  const Light hard = ParseLight(
      "\"spot\" \"float power\" 7 \"float coneangle\" 60 \"float conedeltaangle\" 0");
  CHECK(hard.emission.y == Approx(7 / (2 * kPi * (1 - 0.5))));
  // With one, the smoothstep s(t) = t^2 (3 - 2 t) in the cosine, integrated numerically.
  const Light soft = ParseLight(
      "\"spot\" \"float power\" 7 \"float coneangle\" 60 \"float conedeltaangle\" 30");
  const double inner = std::cos(kPi / 6), outer = std::cos(kPi / 3);
  double ring = 0;
  constexpr int kSteps = 10000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    ring += t * t * (3 - 2 * t) * (inner - outer) / kSteps;
  }
  CHECK(soft.emission.y == Approx(7 / (2 * kPi * (1 - inner + ring))));
}

TEST_CASE("distant and infinite lights", "[parse]") {
  const Light sun = ParseLight(
      "\"distant\" \"rgb L\" [ 1 0.5 0.25 ] \"float illuminance\" 8 "
      "\"point3 from\" [ 0 0 1 ] \"point3 to\" [ 0 0 0 ]");
  CHECK(sun.kind == LightKind::kDistant);
  CheckColor(sun.emission, {8, 4, 2});
  const Light sky =
      ParseLight("\"infinite\" \"rgb L\" [ 1 1 1 ] \"float illuminance\" 3");
  CHECK(sky.kind == LightKind::kInfinite);
  CheckColor(sky.emission, Rgb{1, 1, 1} * (3 / kPi));
  CHECK(sky.illuminance == -1);
  const Light map = ParseLight(
      "\"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 4 "
      "\"float illuminance\" 3");
  CHECK(map.image_path == "./sky.exr");
  CHECK(map.image_scale == 4);
  CHECK(map.illuminance == 3);
}

// In pbrt-v4's Create of every light: scale / photometric(colour), where that of `rgb` is
// the illuminant's alone, so that its numbers are factors; then times the target over
// what the light would have at a scale of 1. Power: 4 pi; 2 pi ((1 - cos inner) + (cos
// inner - cos outer) / 2). Illuminance: 1; pi.
TEST_CASE("colour, scale and target of a light multiply", "[parse]") {
  const std::string scale = "\"float scale\" 2 ", power = scale + "\"float power\" 100";
  const std::string illuminance = scale + "\"float illuminance\" 100";
  const Rgb rgb = {1, 2, 3};
  CheckColor(ParseLight("\"point\" \"rgb I\" [ 1 2 3 ] " + power).emission,
             rgb * (200 / (4 * kPi)));
  const double cone =
      2 * kPi * ((1 - std::cos(kPi / 9)) + (std::cos(kPi / 9) - std::cos(kPi / 6)) / 2);
  CheckColor(ParseLight("\"spot\" \"float coneangle\" 30 \"float conedeltaangle\" 10 "
                        "\"rgb I\" [ 1 2 3 ] " +
                        power)
                 .emission,
             rgb * (200 / cone));
  CheckColor(ParseLight("\"distant\" \"rgb L\" [ 1 2 3 ] " + illuminance).emission,
             rgb * 200);
  CheckColor(ParseLight("\"infinite\" \"rgb L\" [ 1 2 3 ] " + illuminance).emission,
             rgb * (200 / kPi));
}

// pbrt-v4 makes an image of one pixel of the sky behind a portal. SpectrumToXYZ divides
// by the integral of the photometric curve only. A constant spectrum of 1 thus has
// luminance 1, and so has D65, which pbrt stores in that scale. The maximum of a black
// body is 1; at 6500 K it lies at 446 nm. If the map is scaled to an illuminance, the
// pixel stands for all of it: 2 pi times it falls on a surface, by pbrt's sum.
TEST_CASE("a constant sky behind a portal agrees with pbrt", "[parse]") {
  const auto sky = [](const std::string& text) {
    return ParseLight("\"infinite\" \"point3 portal\" [ 0 0 0  0 1 0  2 1 0  2 0 0 ] " +
                      text);
  };
  CheckColor(sky("").emission, {1, 1, 1});
  CheckColor(sky("\"rgb L\" [ 1 2 3 ] \"float scale\" 2").emission, {2, 4, 6});
  CHECK(Luminance(sky("\"spectrum L\" [ 300 7 900 7 ]").emission) ==
        Approx(7).epsilon(1e-3));
  CHECK(Luminance(sky("\"spectrum L\" \"stdillum-D65\"").emission) ==
        Approx(1).epsilon(1e-3));
  // Planck's law over its maximum, which is at x = h c / (lambda k T) = 4.965: (x
  // / 4.965)^5 (e^4.965 - 1) / (e^x - 1), summed with the photometric curve in steps of
  // 10 nm.
  CHECK(Luminance(sky("\"blackbody L\" 6500").emission) == Approx(0.8859).epsilon(1e-3));
  CheckColor(sky("\"float illuminance\" 3").emission, Rgb{1, 1, 1} * (3 / (2 * kPi)));
  CheckColor(sky("\"rgb L\" [ 5 5 5 ] \"float illuminance\" 3").emission,
             Rgb{1, 1, 1} * (3 / (2 * kPi)));
}

TEST_CASE("a light without a colour has its color space's illuminant", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    LightSource "point"
    ColorSpace "rec2020"
    LightSource "point"
    ColorSpace "aces2065-1"
    LightSource "distant"
    AreaLightSource "diffuse"
    Shape "sphere"
    AreaLightSource "diffuse" "string filename" "screen.png"
    Shape "sphere")");
  CheckColor(scene.lights[0].emission, {1, 1, 1});
  CheckColor(scene.lights[1].emission, {1, 1, 1});
  // D60: warmer, and as bright.
  Rgb d60;
  REQUIRE(NamedSpectrum("illum-acesD60", SpectrumUse::kIlluminant, &d60));
  CHECK(d60.x > 1.02);
  for (const Rgb found : {scene.lights[2].emission, scene.area_lights[0].radiance}) {
    for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(d60[c]).epsilon(3e-3));
  }
  CHECK(scene.area_lights[1].radiance == Rgb{1, 1, 1});  // the image has its own colours
}

TEST_CASE("emission spectra have luminance one times the scale", "[parse]") {
  const Light body = ParseLight("\"point\" \"blackbody I\" 5000 \"float scale\" 3");
  CheckColor(body.emission, RgbFromBlackbody(5000) * 3);
  CHECK(Luminance(body.emission) == Approx(3).epsilon(1e-3));
  const Light flat = ParseLight("\"point\" \"spectrum I\" [ 300 7 900 7 ]");
  CHECK(Luminance(flat.emission) == Approx(1).epsilon(1e-3));
  Rgb d65;
  REQUIRE(NamedSpectrum("stdillum-D65", SpectrumUse::kIlluminant, &d65));
  CheckColor(ParseLight("\"point\" \"spectrum I\" \"stdillum-D65\"").emission, d65);
  // A candle's blue is outside the gamut of sRGB; no emission is negative.
  CHECK(ParseLight("\"point\" \"blackbody I\" 1000").emission.z == 0);
}

TEST_CASE("rgb is converted from its color space", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    ColorSpace "rec2020"
    LightSource "point" "rgb I" [ 0.2 0.3 0.4 ]
    AttributeBegin
      ColorSpace "srgb"
      LightSource "point" "rgb I" [ 0.2 0.3 0.4 ]
    AttributeEnd)");
  CheckColor(scene.lights[0].emission,
             ToSrgb("rec2020", {0.2, 0.3, 0.4}, SpectrumUse::kIlluminant));
  CheckColor(scene.lights[1].emission, {0.2, 0.3, 0.4});
  CHECK(scene.lights[0].emission.x != Approx(0.2).epsilon(1e-3));
}

TEST_CASE("lights with an image", "[parse]") {
  const Light map = ParseLight(
      "\"goniometric\" \"string filename\" \"lamp.exr\" \"rgb I\" [ 1 2 3 ] "
      "\"float scale\" 2 \"float power\" 60");
  CHECK(map.kind == LightKind::kGoniometric);
  CHECK(map.image_path == "./lamp.exr");
  CHECK(map.power == 60);
  CheckColor(map.emission, {2, 4, 6});
  const Light slide =
      ParseLight("\"projection\" \"string filename\" \"slide.png\" \"float fov\" 30");
  CHECK(slide.kind == LightKind::kProjection);
  CHECK(slide.fov == 30);
  CHECK(slide.power == -1);
  CheckColor(slide.emission, {1, 1, 1});
  const Light sky = ParseLight(
      "\"infinite\" \"rgb L\" [ 1 1 1 ] \"point3 portal\" [ 0 0 0  0 1 0  2 1 0  2 0 0 "
      "]");
  REQUIRE(sky.portal.size() == 4);
  CHECK(sky.portal[2] == Vec3d{2, 1, 0});
  const SceneDescription scene = ParseWorld(R"(
    AreaLightSource "diffuse" "string filename" "screen.png" "float scale" 3
    Shape "sphere")");
  REQUIRE(scene.area_lights.size() == 1);
  CHECK(scene.area_lights[0].image_path == "./screen.png");
  CHECK(scene.area_lights[0].radiance == Rgb{1, 1, 1});
  CHECK_THROWS_AS(ParseWorld("AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ] "
                             "\"string filename\" \"a.exr\""),
                  InputError);
  CHECK_THROWS_AS(ParseLight("\"projection\" \"string filename\" \"a.exr\" \"rgb I\" "
                             "[ 1 1 1 ]"),
                  InputError);  // as in pbrt
}

TEST_CASE("area lights", "[parse]") {
  const SceneDescription scene = ParseWorld(R"(
    AreaLightSource "diffuse" "rgb L" [ 1 2 3 ] "float scale" 2 "bool twosided" true
      "float power" 60
    Shape "sphere"
    Shape "disk")");
  REQUIRE(scene.area_lights.size() == 1);
  CHECK(scene.area_lights[0].radiance == Rgb{1, 2, 3});
  CHECK(scene.area_lights[0].scale == 2);
  CHECK(scene.area_lights[0].power == 60);
  CHECK(scene.area_lights[0].two_sided);
  CHECK(scene.shapes[1].area_light == 0);
}

}  // namespace
}  // namespace lanelight
