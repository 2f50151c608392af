// Parameters of hair, curves, coats, image lights and noise with values other than the
// defaults, as in parameters_test.cc.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/image/image.h"
#include "tests/agreement/parameter_rows.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight::test {
namespace {

const std::string kDepth1 = "Integrator \"path\" \"integer maxdepth\" 1 ";

// Unpolarised reflectance of a dielectric.
double FibreFresnel(double cosine, double eta) {
  const double t = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
  const double s = (cosine - eta * t) / (cosine + eta * t);
  const double p = (eta * cosine - t) / (eta * cosine + t);
  return (s * s + p * p) / 2;
}

// What a fibre met at h across its width sends back of an even light: the lobes of Chiang
// et al. (2016) integrate to 1, so that only their weights count.
double HairAlbedo(double h, double eta, double sigma_a) {
  const double f = FibreFresnel(std::sqrt(1 - h * h), eta);
  const double through = std::exp(-2 * sigma_a * std::sqrt(1 - h * h / (eta * eta)));
  return f + (1 - f) * (1 - f) * through / (1 - f * through);
}
Rgb HairAlbedos(double h, double eta, Rgb sigma_a) {
  return {HairAlbedo(h, eta, sigma_a.x), HairAlbedo(h, eta, sigma_a.y),
          HairAlbedo(h, eta, sigma_a.z)};
}

// Of a colour and beta_n: equation 9 of the same.
double HairSigma(double color, double b) {
  const double fit = 5.969 - 0.215 * b + 2.532 * b * b - 10.73 * std::pow(b, 3) +
                     5.574 * std::pow(b, 4) + 0.245 * std::pow(b, 5);
  return std::pow(std::log(color) / fit, 2);
}

constexpr const char* kAlongX =
    "\"point3 P\" [ -1 0 0  -0.333333333 0 0  0.333333333 0 0  1 0 0 ] ";

// A strand along x, 2 wide, met at h = 0.5.
std::string Strand(const std::string& parameters) {
  return Sky(1) + "Material \"hair\" " + parameters +
         " Translate 0 -0.3 0 Shape \"curve\" \"float width\" 2 " + kAlongX;
}
// Grey curves before a white sky, met at u = 0.55 and 0.2 aside of the middle.
std::string GreyCurve(const std::string& parameters, const std::string& before = "") {
  return Sky(1) + kDiffuse + before + " Shape \"curve\" " + parameters;
}

std::vector<Row> HairRows() {
  const Rgb eumelanin = {0.419, 0.697, 1.37}, pheomelanin = {0.187, 0.4, 1.05};
  return {
      {"hair, defaults", Strand(""), HairAlbedos(0.5, 1.55, eumelanin * 1.3), kDepth1},
      {"hair sigma_a, eta, beta_m, beta_n, alpha",
       Strand("\"rgb sigma_a\" [ 0.2 0.5 1 ] \"float eta\" 1.7 \"float beta_m\" 0.5 "
              "\"float beta_n\" 0.6 \"float alpha\" 4"),
       HairAlbedos(0.5, 1.7, {0.2, 0.5, 1}), kDepth1, 5e-3},
      {"hair eumelanin, pheomelanin",
       Strand("\"float eumelanin\" 0.4 \"float pheomelanin\" 0.3"),
       HairAlbedos(0.5, 1.55, eumelanin * 0.4 + pheomelanin * 0.3), kDepth1},
      {"hair reflectance, beta_n",
       Strand("\"rgb reflectance\" [ 0.7 0.5 0.3 ] \"float beta_n\" 0.5"),
       HairAlbedos(0.5, 1.55,
                   {HairSigma(0.7, 0.5), HairSigma(0.5, 0.5), HairSigma(0.3, 0.5)}),
       kDepth1, 5e-3}};
}

std::vector<Row> CurveRows() {
  const std::string spline =
      "\"point3 P\" [ -3 0 0  -1 0 0  1 0 0  3 0 0 ] \"float width\" 1 ";
  const std::string ribbon =
      std::string(kAlongX) + "\"float width\" 1 \"string type\" \"ribbon\" ";
  const std::string sun =
      "LightSource \"distant\" \"point3 from\" [ 0 0 1 ] \"point3 to\" [ 0 0 0 ] ";
  return {
      {"curve, default width", GreyCurve(kAlongX), Grey(0.5)},
      {"curve width", GreyCurve(std::string(kAlongX) + "\"float width\" 0.38"), Grey(1)},
      {"curve width0",
       GreyCurve(std::string(kAlongX) + "\"float width0\" 0.8 \"float width1\" 0"),
       Grey(1)},
      {"curve width1",
       GreyCurve(std::string(kAlongX) + "\"float width0\" 0 \"float width1\" 0.8"),
       Grey(0.5)},
      {"curve, default basis", GreyCurve(spline, "Translate 2 0 0"), Grey(0.5)},
      {"curve basis",
       GreyCurve(spline + "\"string basis\" \"bspline\"", "Translate 2 0 0"), Grey(1)},
      {"curve degree",
       GreyCurve(
           "\"integer degree\" 2 \"float width\" 1 \"point3 P\" [ -1 0 0  0 0 0  1 0 0 "
           "]"),
       Grey(0.5)},
      {"curve type ribbon, N", GreyCurve(ribbon + "\"normal N\" [ 0 0 1  0 0 1 ]"),
       Grey(0.5)},
      {"curve type ribbon, N turned away",
       GreyCurve(ribbon + "\"normal N\" [ 0 0.95 0.3122  0 0.95 0.3122 ]"), Grey(1)},
      {"curve type flat",
       sun + kDiffuse + "Translate 0 -0.3 0 Shape \"curve\" \"float width\" 2 " + kAlongX,
       Grey(0.5 / kPi)},
      // A quarter of the width aside: normals turn by 45 degrees.
      {"curve type cylinder",
       sun + kDiffuse + "Translate 0 -0.3 0 Shape \"curve\" \"float width\" 2 " +
           kAlongX + "\"string type\" \"cylinder\"",
       Grey(0.5 / kPi * std::sqrt(0.5)), "", 2e-3},
      {"curve, stretched",
       GreyCurve(std::string(kAlongX) + "\"float width\" 0.15", "Scale 1 3 1"),
       Grey(0.5)}};
}

std::vector<Row> CoatRows() {
  const auto metal = [](double eta, double k) {
    return (std::pow(eta - 1, 2) + k * k) / (std::pow(eta + 1, 2) + k * k);
  };
  const std::string bare =
      "\"coatedconductor\" \"float interface.eta\" 1 "
      "\"float conductor.roughness\" 0 ";
  return {
      // coats are tables, right within 3 %
      {"coatedconductor conductor.eta, conductor.k, thickness",
       Under(bare + "\"rgb conductor.eta\" [ 0.2 0.9 1.1 ] \"rgb conductor.k\" "
                    "[ 3.9 2.5 2.2 ] \"float thickness\" 0.5"),
       Rgb{metal(0.2, 3.9), metal(0.9, 2.5), metal(1.1, 2.2)} * std::exp(-1), "", 0.03},
      {"coatedconductor reflectance",
       Under(bare + "\"rgb reflectance\" [ 0.2 0.4 0.6 ] \"float thickness\" 1e-6"),
       {0.2, 0.4, 0.6},
       "",
       0.03},
      {"coateddiffuse reflectance, albedo, g, maxdepth: white stays white",
       Under("\"coateddiffuse\" \"rgb reflectance\" [ 1 1 1 ] \"rgb albedo\" [ 1 1 1 ] "
             "\"float g\" 0.4 \"float thickness\" 0.3 "
             "\"integer maxdepth\" 1000"),
       Grey(1), "", 0.03}};
}

constexpr int kSide = 64;

// An even image of radiance (0.25, 0.5, 1).
std::string EvenImage(const TemporaryFolder& folder) {
  Image image = MakeImage(kSide, kSide, {"R", "G", "B"});
  for (int i = 0; i < kSide * kSide; ++i) {
    image.pixels[std::size_t(3 * i)] = 0.25f;
    image.pixels[std::size_t(3 * i + 1)] = 0.5f;
    image.pixels[std::size_t(3 * i + 2)] = 1;
  }
  WritePfm(folder.File("even.pfm"), image);
  return "\"string filename\" \"" + folder.File("even.pfm") + "\" ";
}

std::vector<Row> ImageLightRows(const TemporaryFolder& folder) {
  const Rgb even = {0.25, 0.5, 1};
  const std::string file = EvenImage(folder);
  // 2 above the floor, looking down.
  const auto above = [&](const std::string& light) {
    return "AttributeBegin Translate 0.1 0.2 2 Rotate 180 1 0 0 LightSource " + light +
           " AttributeEnd " + kDiffuse + kFloor;
  };
  const double to_floor = 0.5 / kPi / 4;
  const double luminance = 0.2126 * 0.25 + 0.7152 * 0.5 + 0.0722;
  // pbrt-v4 sums the cosines of the texels above the horizon, times 2 pi over all: half
  // of pi, but for the texels that lie on the horizon.
  const double above_horizon = kPi * (0.5 - 2.0 / (kSide * kSide));
  // The pyramid of sight of 60 degrees: intensity over the cubed cosine is of an even
  // plane, whose integral is the solid angle.
  const double pyramid = 4 * std::asin(std::pow(std::sin(kPi / 6), 2));
  return {{"infinite filename, scale", kSky + file + "\"float scale\" 2", even * 2.0},
          {"infinite filename, illuminance", kSky + file + "\"float illuminance\" 3",
           even * (3 / above_horizon / luminance)},
          {"projection filename, scale, fov",
           above("\"projection\" " + file + "\"float scale\" 2 \"float fov\" 60"),
           even * (2 * to_floor)},
          {"projection power",
           above("\"projection\" " + file + "\"float power\" 8 \"float fov\" 60"),
           even * (8 / (luminance * pyramid) * to_floor)},
          {"goniometric filename, I, scale",
           above("\"goniometric\" " + file + "\"rgb I\" [ 2 2 2 ] \"float scale\" 3"),
           Grey(6 * (0.25 + 0.5 + 1) / 3 * to_floor)}};
}

// A texture of the space whose point (0.3701, 0.6102, 0.83) fills the sight, and what the
// scalar twin has there.
Row NoiseRow(const char* parameter, const std::string& texture) {
  Row row;
  row.parameter = parameter;
  row.world =
      Sky(1) + "AttributeBegin Translate -370 -610 -830 Scale 1000 1000 1000 " + texture +
      " AttributeEnd Material \"diffuse\" \"texture reflectance\" \"t\" " + kFloor;
  const SceneDescription scene =
      ParseText(std::string(kHead) + "WorldBegin\n" + row.world);
  const reference::Textures twin(scene.textures);
  const Index last = scene.materials.back().reflectance.texture;
  row.expected = twin.Eval(last, {0, 0, {0.1, 0.2, 0}, {0, 0, 1}});
  row.tolerance = 3e-3;
  return row;
}
std::string Scaled(const std::string& noise) {
  return "Texture \"f\" \"float\" " + noise +
         " Texture \"t\" \"spectrum\" \"scale\" \"rgb tex\" [ 0.5 0.5 0.5 ] "
         "\"texture scale\" \"f\"";
}

std::vector<Row> NoiseRows() {
  return {NoiseRow("fbm, defaults", Scaled("\"fbm\"")),
          NoiseRow("fbm octaves, roughness",
                   Scaled("\"fbm\" \"integer octaves\" 3 \"float roughness\" 0.9")),
          NoiseRow("wrinkled, defaults", Scaled("\"wrinkled\"")),
          NoiseRow("wrinkled octaves, roughness",
                   Scaled("\"wrinkled\" \"integer octaves\" 3 \"float roughness\" 0.3")),
          NoiseRow("windy", Scaled("\"windy\"")),
          NoiseRow("marble, defaults", "Texture \"t\" \"spectrum\" \"marble\""),
          NoiseRow("marble octaves, roughness, scale, variation",
                   "Texture \"t\" \"spectrum\" \"marble\" \"integer octaves\" 3 \"float "
                   "roughness\" 0.7 \"float scale\" 2 \"float variation\" 0.4")};
}

}  // namespace

TEST_CASE("parameters of hair have pbrt's meaning", "[agreement][parameters]") {
  CheckRows(HairRows());
}

TEST_CASE("parameters of curves have pbrt's meaning", "[agreement][parameters]") {
  CheckRows(CurveRows());
}

TEST_CASE("parameters of coats have pbrt's meaning", "[agreement][parameters]") {
  CheckRows(CoatRows());
}

TEST_CASE("parameters of image lights have pbrt's meaning", "[agreement][parameters]") {
  const TemporaryFolder folder;
  CheckRows(ImageLightRows(folder));
}

TEST_CASE("parameters of noise textures have pbrt's meaning", "[agreement][parameters]") {
  CheckRows(NoiseRows());
}

}  // namespace lanelight::test
