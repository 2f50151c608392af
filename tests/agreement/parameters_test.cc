// Parameters that pbrt-v4 knows too, with values other than its defaults, and defaults
// that a closed form shows. Each scene fills the image with one radiance.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/agreement/parameter_rows.h"

namespace lanelight::test {
namespace {

// Black, so that nothing comes through from below.
constexpr const char* kBlack =
    "AttributeBegin Translate 0 0 -1 Material \"diffuse\" \"rgb reflectance\" [ 0 0 0 ] "
    "Shape \"disk\" \"float radius\" 1000 AttributeEnd ";

std::string Glass(const std::string& material) { return kBlack + Under(material); }
std::string Emitter(const std::string& parameters, const std::string& shape) {
  return "AreaLightSource \"diffuse\" " + parameters + " " + kDiffuse +
         "\"rgb reflectance\" [ 0 0 0 ] " + shape;
}
// A slab of a medium that fills 1 of the sight, before a sky.
std::string Slab(const std::string& medium, double sky) {
  return Sky(sky) + "MakeNamedMedium \"m\" \"string type\" " + medium +
         " MediumInterface \"m\" \"\" Material \"interface\" Scale 1000 1000 1 "
         "Shape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 3 2  4 5 6 4 6 7  "
         "0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7 ] "
         "\"point3 P\" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0  -1 -1 1  1 -1 1  1 1 1  -1 1 1 "
         "]";
}

double Fresnel(double eta) { return std::pow((eta - 1) / (eta + 1), 2); }
double MetalHeadOn(double eta, double k) {
  return (std::pow(eta - 1, 2) + k * k) / (std::pow(eta + 1, 2) + k * k);
}

std::vector<Row> LightRows() {
  const double cone = kPi * ((1 - std::cos(40 * kPi / 180)) + (1 - std::cos(kPi / 6)));
  return {
      {"infinite L, scale",
       std::string(kSky) + "\"rgb L\" [ 1 2 3 ] \"float scale\" 2",
       {2, 4, 6}},
      {"infinite, defaults", kSky, {1, 1, 1}},
      {"infinite illuminance", std::string(kSky) + "\"float illuminance\" 3",
       Grey(3 / kPi)},
      {"point I, from, scale",
       Lit("\"point\" \"rgb I\" [ 1 2 3 ] \"point3 from\" [ 0.1 0.2 2 ] \"float scale\" "
           "2"),
       Rgb{1, 2, 3} * (0.5 / kPi * 2 / 4)},
      {"point, defaults",
       std::string("AttributeBegin Translate 0.1 0.2 2 LightSource \"point\" "
                   "AttributeEnd ") +
           kDiffuse + kFloor,
       Grey(0.5 / kPi / 4)},
      {"point power", Lit("\"point\" \"point3 from\" [ 0.1 0.2 2 ] \"float power\" 8"),
       Grey(0.5 / kPi * 8 / (4 * kPi) / 4)},
      {"spot coneangle, conedeltaangle, power",
       Lit("\"spot\" \"point3 from\" [ 0.1 0.2 2 ] \"point3 to\" [ 0.1 0.2 0 ] "
           "\"float coneangle\" 40 \"float conedeltaangle\" 10 \"float power\" 8"),
       Grey(0.5 / kPi * 8 / cone / 4)},
      {"distant L, from, to, scale",
       Lit("\"distant\" \"rgb L\" [ 1 2 3 ] \"point3 from\" [ 1 0 1 ] \"point3 to\" "
           "[ 0 0 0 ] \"float scale\" 2"),
       Rgb{1, 2, 3} * (0.5 / kPi * 2 * std::sqrt(0.5))},
      {"distant illuminance",
       Lit("\"distant\" \"point3 from\" [ 0 0 1 ] \"point3 to\" [ 0 0 0 ] "
           "\"float illuminance\" 5"),
       Grey(0.5 / kPi * 5)},
      {"diffuse L, scale",
       Emitter("\"rgb L\" [ 1 2 3 ] \"float scale\" 2", kFloor),
       {2, 4, 6}},
      {"diffuse twosided",
       Emitter("\"bool twosided\" true", "ReverseOrientation Shape \"disk\""),
       {1, 1, 1}},
      {"diffuse, one side", Emitter("", "ReverseOrientation Shape \"disk\""), {0, 0, 0}},
      {"diffuse power", Emitter("\"float power\" 8", "Shape \"disk\" \"float radius\" 2"),
       Grey(8 / (kPi * 4 * kPi))},
      {"diffuse power, twosided",
       Emitter("\"float power\" 8 \"bool twosided\" true", "Shape \"disk\""),
       Grey(8 / (2 * kPi * kPi))}};
}

// Through a clear coat of this thickness to a Lambertian base, and back to the normal.
double ThroughCoat(double thickness) {
  constexpr int kSteps = 10000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    sum += 2 * cosine * std::exp(-thickness / cosine) / kSteps;
  }
  return std::exp(-thickness) * sum;
}

std::vector<Row> MaterialRows() {
  return {
      {"diffuse, default reflectance", Under("\"diffuse\""), Grey(0.5)},
      {"diffuse reflectance",
       Under("\"diffuse\" \"rgb reflectance\" [ 0.2 0.4 0.6 ]"),
       {0.2, 0.4, 0.6}},
      {"diffusetransmission, defaults", Under("\"diffusetransmission\""), Grey(0.5)},
      {"diffusetransmission reflectance, transmittance, scale",
       Under("\"diffusetransmission\" \"rgb reflectance\" [ 0.1 0.2 0.3 ] "
             "\"rgb transmittance\" [ 0.4 0.2 0.1 ] \"float scale\" 0.5"),
       {0.25, 0.2, 0.2}},
      {"diffusetransmission scale above 1: each is clamped",
       Under("\"diffusetransmission\" \"rgb reflectance\" [ 0.9 0.3 0.1 ] "
             "\"rgb transmittance\" [ 0.5 0.8 0.4 ] \"float scale\" 1.5"),
       {1.75, 1.45, 0.75}},
      {"diffusetransmission scale above 1, textured",
       "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [ 0.9 0.9 0.9 ] "
       "\"rgb tex2\" [ 0.8 0.8 0.8 ] " +
           Under("\"diffusetransmission\" \"texture reflectance\" \"t\" "
                 "\"rgb transmittance\" [ 0.4 0.4 0.4 ] \"float scale\" 1.5"),
       Grey(1.6)},
      {"dielectric, default eta", Glass("\"dielectric\""), Grey(Fresnel(1.5))},
      {"dielectric eta", Glass("\"dielectric\" \"float eta\" 1.8"), Grey(Fresnel(1.8))},
      {"thindielectric eta", Glass("\"thindielectric\" \"float eta\" 1.8"),
       Grey(2 * Fresnel(1.8) / (1 + Fresnel(1.8)))},
      {"conductor eta, k",
       Under("\"conductor\" \"rgb eta\" [ 0.2 0.9 1.1 ] \"rgb k\" [ 3.9 2.5 2.2 ]"),
       {MetalHeadOn(0.2, 3.9), MetalHeadOn(0.9, 2.5), MetalHeadOn(1.1, 2.2)}},
      {"conductor reflectance",
       Under("\"conductor\" \"rgb reflectance\" [ 0.2 0.4 0.6 ]"),
       {0.2, 0.4, 0.6}},
      {"coateddiffuse thickness, eta",  // coats are tables, right within 3 %
       Under("\"coateddiffuse\" \"float thickness\" 0.5 \"float eta\" 1"),
       Grey(0.5 * ThroughCoat(0.5)), "", 0.03},
      {"mix amount",
       "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"rgb reflectance\" [ 0 0 0 "
       "] "
       "MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \"rgb reflectance\" [ 1 1 1 "
       "] " +
           Under("\"mix\" \"string materials\" [ \"a\" \"b\" ] \"float amount\" 0.25"),
       Grey(0.25)},
      {"alpha",
       Emitter("\"float scale\" 4", std::string(kFloor) + "\"float alpha\" 0.25"),
       Grey(1), "", 5e-3}};
}

std::vector<Row> TextureRows() {
  return {
      {"constant value",
       Textured("\"constant\" \"rgb value\" [ 0.2 0.4 0.6 ]"),
       {0.2, 0.4, 0.6}},
      {"scale tex, scale",
       Textured("\"scale\" \"rgb tex\" [ 0.2 0.4 0.6 ] \"float scale\" 0.5"),
       {0.1, 0.2, 0.3}},
      {"mix, default amount",
       Textured("\"mix\" \"rgb tex1\" [ 0.2 0.4 0.6 ] \"rgb tex2\" [ 0.4 0.4 0.2 ]"),
       {0.3, 0.4, 0.4}},
      {"mix amount", Textured("\"mix\" \"float amount\" 0.2"), Grey(0.2)},
      {"bilerp v00, v01, v10, v11",
       Textured("\"bilerp\" \"rgb v00\" [ 0.1 0.1 0.1 ] \"rgb v01\" [ 0.9 0.9 0.9 ] "
                "\"rgb v10\" [ 0.5 0.5 0.5 ] \"rgb v11\" [ 0.3 0.3 0.3 ]"),
       Grey(0.45 * (0.4 * 0.1 + 0.6 * 0.9) + 0.55 * (0.4 * 0.5 + 0.6 * 0.3)), "", 2e-3},
      {"bilerp uscale, vscale, udelta, vdelta",
       Textured(
           "\"bilerp\" \"float uscale\" 0.5 \"float vscale\" 0.5 \"float udelta\" 0.1 "
           "\"float vdelta\" 0.2"),
       Grey(0.5), "", 2e-3},
      {"checkerboard, first",
       Textured("\"checkerboard\" \"float uscale\" 4 \"float "
                "vscale\" 4 \"rgb tex1\" [ 0.2 0.4 0.6 ]"),
       {0.2, 0.4, 0.6}},
      {"checkerboard udelta, default tex2",
       Textured(
           "\"checkerboard\" \"float uscale\" 4 \"float vscale\" 4 \"float udelta\" 1"),
       {0, 0, 0}},
      {"checkerboard dimension",
       Textured("\"checkerboard\" \"integer dimension\" 3 \"rgb tex2\" "
                "[ 0.3 0.3 0.3 ]",
                1.5),
       Grey(0.3)},
      {"directionmix dir",
       Textured("\"directionmix\" \"vector3 dir\" [ 0 0.6 0.8 ] \"rgb tex1\" "
                "[ 0.5 0.5 0.5 ]"),
       Grey(0.8 * 0.5 + 0.2 * 1)}};
}

std::vector<Row> MediumRows() {
  const std::string direct = "Integrator \"volpath\" \"integer maxdepth\" 0 ";
  const std::string grid =
      "\"uniformgrid\" \"integer nx\" 1 \"integer nz\" 1 \"float density\" 1 \"point3 "
      "p0\" "
      "[ -1e6 -1e6 -1e6 ] \"point3 p1\" [ 1e6 1e6 1e6 ] ";
  return {{"homogeneous, default sigma_a and sigma_s", Slab("\"homogeneous\"", 1),
           Grey(std::exp(-2)), direct},
          {"homogeneous, default sigma_a",
           Slab("\"homogeneous\" \"rgb sigma_s\" [ 0 1 2 ]", 1),
           {std::exp(-1), std::exp(-2), std::exp(-3)},
           direct},
          {"homogeneous, default sigma_s",
           Slab("\"homogeneous\" \"rgb sigma_a\" [ 0 1 2 ]", 1),
           {std::exp(-1), std::exp(-2), std::exp(-3)},
           direct},
          {"homogeneous scale",
           Slab("\"homogeneous\" \"rgb sigma_a\" [ 1 1 1 ] \"rgb sigma_s\" [ 0 0 0 ] "
                "\"float scale\" 0.5",
                1),
           Grey(std::exp(-0.5))},
          {"homogeneous Le, Lescale",
           Slab("\"homogeneous\" \"rgb sigma_a\" [ 1 1 1 ] \"rgb sigma_s\" [ 0 0 0 ] "
                "\"rgb Le\" [ 1 2 3 ] \"float Lescale\" 2",
                0),
           Rgb{2, 4, 6} * (1 - std::exp(-1))},
          {"homogeneous g: a white medium changes nothing",
           Slab("\"homogeneous\" \"rgb sigma_a\" [ 0 0 0 ] \"float g\" 0.7", 1), Grey(1),
           "Integrator \"volpath\" \"integer maxdepth\" 1000 "},
          {"rgbgrid sigma_a, sigma_s, scale",
           Slab("\"rgbgrid\" \"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 0 0 0 ] "
                "\"float scale\" 0.5 \"point3 p0\" [ -1e6 -1e6 -1e6 ] \"point3 p1\" "
                "[ 1e6 1e6 1e6 ]",
                1),
           {std::exp(-0.5), std::exp(-1), std::exp(-1.5)}},
          {"uniformgrid scale, defaults of sigma", Slab(grid + "\"float scale\" 0.5", 1),
           Grey(std::exp(-1)), direct},
          {"uniformgrid Le, default Lescale",
           Slab(grid + "\"rgb sigma_s\" [ 0 0 0 ] \"rgb Le\" [ 1 2 3 ]", 0),
           Rgb{1, 2, 3} * (1 - std::exp(-1))}};
}

std::vector<Row> OtherRows() {
  const std::string sky = Sky(1);
  const auto film = [](const char* parameters) {
    return fmt::format(
        "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4 {} ",
        parameters);
  };
  return {
      {"film iso", sky, Grey(2), film("\"float iso\" 200")},
      // Of X, Y and Z, the last of which is 1.089 of white.
      {"film maxcomponentvalue", sky, Grey(0.5 / 1.089),
       film("\"float maxcomponentvalue\" 0.5")},
      {"shutterclose: exposure", sky, Grey(0.25),
       "Camera \"orthographic\" \"float shutterclose\" 0.25 "},
      {"disk innerradius",
       sky + Emitter("\"float scale\" 5",
                     "Shape \"disk\" \"float "
                     "innerradius\" 0.5"),
       Grey(1)},
      {"disk phimax",
       sky + Emitter("\"float scale\" 5",
                     "Shape \"disk\" \"float "
                     "phimax\" 30"),
       Grey(1)},
      {"sphere zmax",
       sky + Emitter("\"float scale\" 5",
                     "Shape \"sphere\" \"float zmin\" "
                     "0 \"float zmax\" 0.5"),
       Grey(1)},
      {"sphere zmin",
       sky + Emitter("\"float scale\" 5",
                     "Shape \"sphere\" \"float zmin\" "
                     "0.5"),
       Grey(5)},
      // 1.25 aside of the eye at a distance of 5: with the default fov it would be 2.5.
      {"perspective fov, screenwindow",
       sky + Emitter("\"float scale\" 5", "Shape \"disk\" \"float radius\" 1.5"), Grey(5),
       "Camera \"perspective\" \"float fov\" 53.13 \"float screenwindow\" "
       "[ 0.49 0.51 -0.01 0.01 ] "},
      {"perspective, default fov",
       sky + Emitter("\"float scale\" 5", "Shape \"disk\" \"float radius\" 1.5"), Grey(1),
       "Camera \"perspective\" \"float screenwindow\" [ 0.49 0.51 -0.01 0.01 ] "},
      {"maxdepth 0: nothing but emission", sky + kDiffuse + kFloor, Grey(0),
       "Integrator \"path\" \"integer maxdepth\" 0 "}};
}

}  // namespace

TEST_CASE("parameters of lights have pbrt's meaning", "[agreement][parameters]") {
  CheckRows(LightRows());
}

TEST_CASE("parameters of materials have pbrt's meaning", "[agreement][parameters]") {
  CheckRows(MaterialRows());
}

TEST_CASE("parameters of textures have pbrt's meaning", "[agreement][parameters]") {
  CheckRows(TextureRows());
}

TEST_CASE("parameters of media have pbrt's meaning", "[agreement][parameters]") {
  CheckRows(MediumRows());
}

TEST_CASE("parameters of films, shapes and integrators have pbrt's meaning",
          "[agreement][parameters]") {
  CheckRows(OtherRows());
}

}  // namespace lanelight::test
