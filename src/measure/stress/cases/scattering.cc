// Surfaces that are mixed, cut out, let through or textured, at the ends of their range.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"

namespace lanelight::stress {
namespace {

std::vector<Point> Transmission(double share, const Effort& effort) {
  const auto furnace = [&](const char* series, double expected, double r, double t) {
    return Named(series, PlaneFurnace(expected,
                                      "\"diffusetransmission\"" + Grey("reflectance", r) +
                                          Grey("transmittance", t),
                                      0.3, effort));
  };
  return {furnace("all", 1, 1 - share, share),
          furnace("half", 0.5, 0.5 * (1 - share), 0.5 * share),
          furnace("transmission alone", share, 0, share)};
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
  return Named(series, WithRare(Expect(expected, text, {64, 4096, 1}, effort),
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
  return Named(series, WithRare(Expect(1 - 0.5 * alpha, text, {64, 4096, 1}, effort),
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

void AddScatteringCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "materials", Truth::kClosedForm};
  add({"diffuse-transmission", "diffuse transmission of 1e-7 to all of the light",
       "reflection and transmission add up: a furnace shows 1",
       LogAxis("transmitted share", "", {1e-7, 1}, {1e-7, 1e-4, 0.1, 0.5, 0.999, 1}),
       Transmission});
  add({"mix-amount", "a mix of 1e-7 of one material, and of all but 1e-7",
       "a furnace shows the mean of both albedos",
       LogAxis("share of the rarer", "", {1e-9, 0.5}, {1e-7, 0.03, 0.5}), ByMix});
  add({"alpha-cut-out", "alpha of 1e-7, and of 1 - 1e-7",
       "a furnace shows the mean of sheet and background",
       LogAxis("share of the rarer", "", {1e-9, 0.5}, {1e-7, 0.03, 0.5}), ByAlpha});
  add({"checkerboard-scale", "1 to 1e9 cells of a checkerboard per unit",
       "both colours are seen alike often",
       LogAxis("cells per unit", "", {1, 1e5}, Decades(0, 9)), Checkered});
  add({"many-materials", "1 to 10000 materials in one image", "the mean of all albedos",
       LogAxis("materials", "", {1, 1e5}, Decades(0, 4, 2), Decades(0, 5)),
       ManyMaterials});
}

}  // namespace lanelight::stress
