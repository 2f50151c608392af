// Coats over a diffuse base and over metal: thickness, index, depth of the walk.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "src/stress/cases/cases.h"
#include "src/stress/cases/transport_setup.h"
#include "src/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

constexpr double kView = 0.6;  // cosine

Point CoatedFurnace(const std::string& series, const std::string& material,
                    double expected, const Effort& effort) {
  Quality quality;
  quality.depth = 1;
  return Named(series, Expect(expected, ViewOfPlane(kView) + Sky(1) + Plane(material),
                              quality, effort));
}

std::string Plastic(const Coat& coat, int depth) {
  return fmt::format(
      "\"coateddiffuse\" \"rgb reflectance\" [{0:.17g} {0:.17g} {0:.17g}] \"float "
      "roughness\" 0 \"float eta\" {1:.17g} \"float thickness\" {2:.17g} \"integer "
      "maxdepth\" {3}",
      coat.albedo, coat.eta, coat.thickness, depth);
}

// The walk of `depth` layers meets the base at every second one.
Point PlasticFurnace(const std::string& series, Coat coat, int depth,
                     const Effort& effort) {
  coat.bounces = (depth + 1) / 2;
  return CoatedFurnace(series, Plastic(coat, depth), CoatFurnace(coat, kView), effort);
}

std::string Lacquer(const Coat& coat, int depth) {
  return fmt::format(
      "\"coatedconductor\" \"rgb reflectance\" [0.9 0.9 0.9] \"float "
      "interface.roughness\" "
      "0 \"float conductor.roughness\" 0 \"float interface.eta\" {:.17g} \"float "
      "thickness\" {:.17g} \"integer maxdepth\" {}",
      coat.eta, coat.thickness, depth);
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

std::vector<Point> ByThickness(double thickness, const Effort& effort) {
  const Coat coat = {0.5, 1.5, thickness};
  return {PlasticFurnace("plastic", coat, 1000, effort),
          CoatedFurnace("lacquer", Lacquer(coat, 1000), LacquerFurnace(coat), effort)};
}

std::vector<Point> ByIndex(double contrast, const Effort& effort) {
  const Coat coat = {0.5, 1 + contrast, 0};
  return {PlasticFurnace("plastic", coat, 1000, effort),
          CoatedFurnace("lacquer", Lacquer(coat, 1000), LacquerFurnace(coat), effort)};
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
  cases.push_back(
      {"coat-thickness", "materials", "absorbing coats 1e-9 to 1e6 thick",
       "a furnace shows what reflection and absorption leave", "", Truth::kClosedForm,
       LogAxis("thickness", "", 0, 1e6, {1e-9, 1e-3, 0.1, 1, 3, 100, 1e6}), ByThickness});
  cases.push_back(
      {"coat-index", "materials", "coats of index 1 + 1e-7 to 11",
       "a furnace shows what entry, bounces and exit leave", "", Truth::kClosedForm,
       LogAxis("index - 1", "", 1e-7, 3, {1e-7, 1e-4, 0.01, 0.3, 1, 3, 10}), ByIndex});
  cases.push_back({"coat-albedo", "materials", "plastic of albedo 0 to 1 - 1e-12",
                   "a furnace shows at most 1, and what entry, bounces and exit leave",
                   "", Truth::kClosedForm,
                   LogAxis("1 - albedo", "", 0, 1, {1e-12, 1e-7, 1e-5, 1e-3, 0.1, 1}),
                   ByAlbedo});
  cases.push_back({"coat-depth", "materials", "walks of 1 to 10000 layers under a coat",
                   "the geometric series ends with the depth", "", Truth::kClosedForm,
                   LogAxis("depth", "", 1, 1e4, {1, 2, 3, 10, 100, 1e4}), CoatsByDepth});
}

}  // namespace lanelight::stress
