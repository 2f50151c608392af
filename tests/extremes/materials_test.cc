// Coats, mixes, cut-outs, transmission and textures at the ends of their range, in a
// furnace.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/measure/stress/closed_forms.h"
#include "tests/extremes/check_points.h"

namespace lanelight::stress {
namespace {

constexpr double kView = 0.6;  // cosine

// What both kinds have, after the roughness: 0.
std::string CoatText(const Coat& coat, int depth, const std::string& prefix) {
  return fmt::format(
      " \"float {}roughness\" 0 \"float {}eta\" {:.17g} \"float thickness\" {:.17g} "
      "\"integer maxdepth\" {}",
      prefix, prefix, coat.eta, coat.thickness, depth);
}

// The walk of `depth` layers meets the base at every second one.
Point PlasticFurnace(const std::string& series, Coat coat, int depth,
                     const Effort& effort) {
  coat.bounces = (depth + 1) / 2;
  const std::string plastic =
      "\"coateddiffuse\"" + Grey("reflectance", coat.albedo) + CoatText(coat, depth, "");
  return Named(series, PlaneFurnace(CoatFurnace(coat, kView), plastic, kView, effort));
}

// Smooth metal under a smooth coat: R + (1 - R)^2 M / (1 - R M), M what the metal and
// the way there and back leave. Faces are seen alike from both sides (Stokes).
double LacquerFurnace(const Coat& coat) {
  const double inside = RefractedCosine(kView, coat.eta);
  const double r = FresnelDielectric(kView, coat.eta);
  const double m = FresnelConductor(inside, 1 / coat.eta, 6 / coat.eta) *
                   std::exp(-2 * coat.thickness / inside);
  return r + (1 - r) * (1 - r) * m / (1 - r * m);
}

std::vector<Point> PlasticAndLacquer(const Coat& coat, const Effort& effort) {
  const std::string lacquer = "\"coatedconductor\" \"float conductor.roughness\" 0" +
                              Grey("reflectance", 0.9) +
                              CoatText(coat, 1000, "interface.");
  return {PlasticFurnace("plastic", coat, 1000, effort),
          Named("lacquer", PlaneFurnace(LacquerFurnace(coat), lacquer, kView, effort))};
}

std::vector<Point> ByThickness(double thickness, const Effort& effort) {
  return PlasticAndLacquer({0.5, 1.5, thickness}, effort);
}

std::vector<Point> ByIndex(double contrast, const Effort& effort) {
  return PlasticAndLacquer({0.5, 1 + contrast, 0}, effort);
}

std::vector<Point> ByAlbedo(double missing, const Effort& effort) {
  std::vector<Point> points = {
      PlasticFurnace("plastic, index 1.5", {1 - missing, 1.5, 0}, 1000, effort),
      PlasticFurnace("plastic, index 10", {1 - missing, 10, 0}, 10000, effort)};
  // A thousandth of the light leaves at each bounce: what is tabulated of it is rounded.
  points.back().tolerance = 1e-3 * points.back().expected;
  return points;
}

std::vector<Point> CoatsByDepth(double depth, const Effort& effort) {
  return {PlasticFurnace("plastic", {0.9, 1.5, 0}, static_cast<int>(depth), effort)};
}

std::vector<Point> Transmission(double fraction, const Effort& effort) {
  const auto furnace = [&](const char* series, double expected, double r, double t) {
    return Named(series, PlaneFurnace(expected,
                                      "\"diffusetransmission\"" + Grey("reflectance", r) +
                                          Grey("transmittance", t),
                                      0.3, effort));
  };
  return {furnace("all", 1, 1 - fraction, fraction),
          furnace("half", 0.5, 0.5 * (1 - fraction), 0.5 * fraction),
          furnace("transmission alone", fraction, 0, fraction)};
}

Point Mixed(const std::string& series, double amount, const Effort& effort) {
  const std::string text =
      ViewOfPlane() + Sky(1) + "MakeNamedMaterial \"dark\" \"string type\" " +
      Diffuse(0.2) + "\nMakeNamedMaterial \"light\" \"string type\" " + Diffuse(0.8) +
      "\n" +
      Plane(fmt::format("\"mix\" \"string materials\" [\"dark\" \"light\"] \"float "
                        "amount\" {:.17g}",
                        amount));
  const double expected = 0.2 * (1 - amount) + 0.8 * amount;
  return Named(series, AllowForRareSamples(Expect(expected, text, {64, 4096, 1}, effort),
                                           std::min(amount, 1 - amount), 0.6));
}

std::vector<Point> ByMix(double rare, const Effort& effort) {
  return {Mixed("amount near 0", rare, effort), Mixed("amount near 1", 1 - rare, effort)};
}

// A sheet between two skies: half of the one where there is a sheet, all of the other
// where not.
Point CutOut(const std::string& series, double alpha, const Effort& effort) {
  const std::string text =
      ViewOfPlane() + Sky(1) + "Material " + Diffuse(0.5) +
      fmt::format("\nShape \"disk\" \"float radius\" 1 \"float alpha\" {:.17g}\n", alpha);
  return Named(series,
               AllowForRareSamples(Expect(1 - 0.5 * alpha, text, {64, 4096, 1}, effort),
                                   std::min(alpha, 1 - alpha), 0.5));
}

std::vector<Point> ByAlpha(double rare, const Effort& effort) {
  return {CutOut("alpha near 0", rare, effort), CutOut("alpha near 1", 1 - rare, effort)};
}

// `scale` cells per unit: a window of 2 x 2 sees as many of both colours.
std::vector<Point> Checkered(double scale, const Effort& effort) {
  const std::string text =
      ViewOfPlane(1, 1) + Sky(1) +
      fmt::format(
          "Texture \"cells\" \"spectrum\" \"checkerboard\" \"float uscale\" "
          "{0:.17g} \"float vscale\" {0:.17g}{1}{2}\n",
          scale, Grey("tex1", 0.2), Grey("tex2", 0.8)) +
      Plane("\"diffuse\" \"texture reflectance\" \"cells\"");
  return {Expect(0.5, text, {64, 4096, 1}, effort)};
}

// n x n quads, each with a material of its own.
std::vector<Point> ManyMaterials(double count, const Effort& effort) {
  const int side = static_cast<int>(std::lround(std::sqrt(count)));
  std::string text = ViewOfPlane(1, 1) + Sky(1);
  const double cell = 2.0 / side;
  for (int i = 0; i < side * side; ++i) {
    const double x = -1 + cell * (i % side), y = -1 + cell * int(i / side);
    text += "Material " + Diffuse((i + 0.5) / (double(side) * side)) + "\n" +
            Rectangle({x, y, 0}, {x + cell, y + cell, 0});
  }
  return {Expect(0.5, text, {64, 4096, 1}, effort)};
}

}  // namespace

TEST_CASE("extremes: absorbing coats 1e-9 to 1e6 thick") {
  CheckPoints({1e-9, 1e-3, 0.1, 1, 3, 100, 1e6}, ByThickness);
}
TEST_CASE("extremes: coats of index 1 + 1e-7 to 4") {
  CheckPoints({1e-7, 1e-4, 0.01, 0.3, 1, 3}, ByIndex);
}
TEST_CASE("extremes: plastic of albedo 0 to 1 - 1e-12") {
  CheckPoints({1e-12, 1e-7, 1e-5, 1e-3, 0.1, 1}, ByAlbedo);
}
TEST_CASE("extremes: walks of 1 to 10 000 layers under a coat") {
  CheckPoints({1, 2, 3, 10, 100, 1e4}, CoatsByDepth);
}
TEST_CASE("extremes: diffuse transmission of 1e-7 to all of the light") {
  CheckPoints({1e-7, 1e-4, 0.1, 0.5, 0.999, 1}, Transmission);
}
TEST_CASE("extremes: mixes and cut-outs of 1e-7 and of all but 1e-7") {
  CheckPoints({1e-7, 0.03, 0.5}, ByMix);
  CheckPoints({1e-7, 0.03, 0.5}, ByAlpha);
}
TEST_CASE("extremes: checkerboards of 1 to 1e5 cells per unit") {
  CheckPoints(Decades(0, 5), Checkered);
}
TEST_CASE("extremes: 1 to 10 000 materials in one image") {
  CheckPoints(Decades(0, 4, 2), ManyMaterials);
}

}  // namespace lanelight::stress
