// Glass of any index, in layers, nested and touching: lossless, so that a furnace
// shows 1.
#include <fmt/format.h>

#include <cmath>
#include <span>
#include <vector>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

Point SphereFurnace(double eta, const Effort& effort) {
  return Expect(1, ViewFrom({0, 0, 5}, 15) + Sky(1) + Sphere({}, 1, Glass(eta)),
                {.depth = 100000}, effort);
}

double RoughFurnace(double eta, double alpha) {
  const auto fresnel = [eta](double c) { return FresnelDielectric(c, eta); };
  const GgxAlbedo albedo = IntegrateGgx(alpha, alpha, 0.5, eta, fresnel);
  return albedo.reflected + albedo.transmitted / (eta * eta);
}

std::vector<Point> NearOne(double contrast, const Effort& effort) {
  std::vector<Point> points;
  for (const bool denser : {true, false}) {
    const double eta = denser ? 1 + contrast : 1 - contrast;
    const std::string sign = denser ? "above 1" : "below 1";
    points.push_back(Named("sphere, " + sign, SphereFurnace(eta, effort)));
    points.push_back(
        Named("thin, " + sign, PlaneFurnace(1, ThinGlass(eta), 0.5, effort)));
    points.push_back(
        Named("alpha 0.3, " + sign,
              PlaneFurnace(RoughFurnace(eta, 0.3), Glass(eta, 0.3), 0.5, effort)));
    points.back().tolerance = 1e-4;  // of the integral
  }
  return points;
}

std::vector<Point> Large(double eta, const Effort& effort) {
  const double f = FresnelDielectric(0.5, eta);
  return {Named("sphere", SphereFurnace(eta, effort)),
          Named("face", PlaneFurnace(f + (1 - f) / (eta * eta), Glass(eta), 0.5, effort)),
          Named("thin", PlaneFurnace(1, ThinGlass(eta), 0.5, effort))};
}

// Faces that are parallel, `gap` apart, with these indices above, between and below.
std::string Layers(std::span<const double> index, double gap) {
  std::string text = ViewOfPlane() + Sky(1);
  for (std::size_t i = 0; i + 1 < index.size(); ++i) {
    text += Block(fmt::format("Translate 0 0 {:.17g}\n", -gap * double(i)) +
                  Plane(Glass(index[i + 1] / index[i])));
  }
  return text;
}

Point Stack(std::span<const double> index, double gap, int depth, const Effort& effort) {
  const double expected = LayersAtNormal(index, depth);
  // What the depth cuts off may be in a few paths only.
  return WithRare(
      Expect(expected, Layers(index, gap), {.quick = 256, .depth = depth}, effort),
      1 - expected, 1);
}

constexpr double kGlassOfWater[] = {1, 1.5, 1.33, 1.5, 1};

std::vector<Point> ByDepth(double depth, const Effort& effort) {
  const double over_air[] = {1, 1.5, 1.33};
  const int events = static_cast<int>(depth);
  return {Named("glass of water", Stack(kGlassOfWater, 0.1, events, effort)),
          Named("into water", Stack(over_air, 0.1, events, effort))};
}

std::vector<Point> ByGap(double gap, const Effort& effort) {
  return {Named("glass of water", Stack(kGlassOfWater, gap, 1000, effort))};
}

std::vector<Point> ByLayers(double layers, const Effort& effort) {
  std::vector<double> index = {1};
  for (int i = 0; i < static_cast<int>(layers); ++i) index.push_back(i % 2 ? 1 : 1.5);
  return {Stack(index, 0.01, 10000, effort)};
}

// A furnace with two spheres: one in the other, or side by side.
std::vector<Point> Nested(double gap, const Effort& effort) {
  const auto furnace = [&](const char* series, const std::string& spheres) {
    return Named(series, Expect(1, ViewFrom({0, 0, 5}, 15) + Sky(1) + spheres,
                                {.depth = 10000}, effort));
  };
  return {furnace("water in glass",
                  Sphere({}, 1, Glass(1.5)) + Sphere({}, 1 - gap, Glass(1.33 / 1.5))),
          furnace("side by side", Sphere({-0.5 - gap / 2, 0, 0}, 0.5, Glass(1.5)) +
                                      Sphere({0.5 + gap / 2, 0, 0}, 0.5, Glass(1.5)))};
}

}  // namespace

void AddGlassCases(std::vector<Case>& cases) {
  const CaseAdder closed_materials{cases, "materials", Truth::kClosedForm};
  const CaseAdder twins{cases, "transport", Truth::kTwin};
  const CaseAdder closed_transport{cases, "transport", Truth::kClosedForm};
  closed_materials({"index-near-one", "index of refraction 1 +- 1 to 1 +- 1e-7",
                    "glass neither darkens nor breaks: in a furnace a sphere and a thin "
                    "sheet show 1, a rough face what its integral is",
                    LogAxis("index - 1", "", {1e-7, 0.5}, {1e-7, 1e-5, 1e-3, 0.1, 0.5},
                            Decades(-7, -0.5, 0.5)),
                    NearOne, "Ignis #16"});
  closed_materials({"index-large", "index of refraction from 1 to 100",
                    "in a furnace a sphere and a thin sheet show 1, a face R + T / eta^2",
                    LogAxis("index", "", {1, 100}, Decades(0, 2), Decades(0, 2, 0.25)),
                    Large});
  twins({"glass-of-water-depth",
         "glass, water and glass in layers, paths of 1 to 10000 events",
         "as much light as a walk over the layers lets through",
         LogAxis("depth", "", {1, 1e4}, {1, 3, 10, 32, 100, 1e4}), ByDepth,
         "openmoonray #62"});
  twins({"touching-faces", "faces of glass and water 1 to 1e-7 apart",
         "as much light as a walk over the layers lets through",
         LogAxis("gap", "", {1e-6, 1}, Decades(-7, 0)), ByGap});
  twins({"many-layers", "1 to 1000 faces of glass behind each other",
         "as much light as a walk over the layers lets through",
         LogAxis("faces", "", {1, 1000}, {1, 10, 100}, {1, 3, 10, 30, 100, 300, 1000}),
         ByLayers});
  closed_transport(
      {"nested-glass", "spheres of glass that nest or touch, with gaps of 0.1 to 1e-7",
       "nothing is lost: a furnace shows 1",
       LogAxis("gap", "radii", {1e-6, 0.1}, Decades(-7, -1, 2), Decades(-7, -1)),
       Nested});
}

}  // namespace lanelight::stress
