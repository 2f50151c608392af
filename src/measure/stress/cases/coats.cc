// Coats over a diffuse base and over metal: thickness, index, depth of the walk.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

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

}  // namespace

void AddCoatCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "materials", Truth::kClosedForm};
  add({"coat-thickness", "absorbing coats 1e-9 to 1e6 thick",
       "a furnace shows what reflection and absorption leave",
       LogAxis("thickness", "", {0, 1e6}, {1e-9, 1e-3, 0.1, 1, 3, 100, 1e6}),
       ByThickness});
  add({"coat-index", "coats of index 1 + 1e-7 to 11",
       "a furnace shows what entry, bounces and exit leave",
       LogAxis("index - 1", "", {1e-7, 3}, {1e-7, 1e-4, 0.01, 0.3, 1, 3, 10}), ByIndex});
  add({"coat-albedo", "plastic of albedo 0 to 1 - 1e-12",
       "a furnace shows at most 1, and what entry, bounces and exit leave",
       LogAxis("1 - albedo", "", {0, 1}, {1e-12, 1e-7, 1e-5, 1e-3, 0.1, 1}), ByAlbedo});
  add({"coat-depth", "walks of 1 to 10000 layers under a coat",
       "the geometric series ends with the depth",
       LogAxis("depth", "", {1, 1e4}, {1, 2, 3, 10, 100, 1e4}), CoatsByDepth});
}

}  // namespace lanelight::stress
