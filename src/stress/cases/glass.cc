// Glass of any index, in layers, nested and touching: lossless, so that a furnace
// shows 1.
#include <fmt/format.h>

#include <cmath>
#include <span>
#include <vector>

#include "src/stress/cases/cases.h"
#include "src/stress/cases/transport_setup.h"
#include "src/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

std::string Dielectric(double eta, double alpha = 0) {
  return fmt::format(
      "\"dielectric\" \"float eta\" {:.17g} \"float roughness\" {:.17g} "
      "\"bool remaproughness\" false",
      eta, alpha);
}

Point SphereFurnace(const std::string& series, double eta, const Effort& effort) {
  Quality quality;
  quality.depth = 100000;
  return Named(
      series,
      Expect(1, ViewFrom({0, 0, 5}, 15) + Sky(1) + Sphere({0, 0, 0}, 1, Dielectric(eta)),
             quality, effort));
}

// A plane of a material between two skies of radiance 1.
Point PlaneFurnace(const std::string& series, const std::string& material,
                   double expected, const Effort& effort) {
  Quality quality;
  quality.depth = 1;
  return Named(series, Expect(expected, ViewOfPlane(0.5) + Sky(1) + Plane(material),
                              quality, effort));
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
    points.push_back(SphereFurnace("sphere, " + sign, eta, effort));
    points.push_back(PlaneFurnace(
        "thin, " + sign, fmt::format("\"thindielectric\" \"float eta\" {:.17g}", eta), 1,
        effort));
    points.push_back(PlaneFurnace("alpha 0.3, " + sign, Dielectric(eta, 0.3),
                                  RoughFurnace(eta, 0.3), effort));
    points.back().tolerance = 1e-4;  // of the integral
  }
  return points;
}

std::vector<Point> Large(double eta, const Effort& effort) {
  const double f = FresnelDielectric(0.5, eta);
  return {
      SphereFurnace("sphere", eta, effort),
      PlaneFurnace("face", Dielectric(eta), f + (1 - f) / (eta * eta), effort),
      PlaneFurnace("thin", fmt::format("\"thindielectric\" \"float eta\" {:.17g}", eta),
                   1, effort)};
}

// Faces that are parallel, `gap` apart, with these indices above, between and below.
std::string Layers(std::span<const double> index, double gap) {
  std::string text = ViewOfPlane() + Sky(1);
  for (std::size_t i = 0; i + 1 < index.size(); ++i) {
    text += fmt::format("AttributeBegin\nTranslate 0 0 {:.17g}\n{}AttributeEnd\n",
                        -gap * double(i), Plane(Dielectric(index[i + 1] / index[i])));
  }
  return text;
}

Point Stack(const std::string& series, std::span<const double> index, double gap,
            int depth, const Effort& effort) {
  Quality quality;
  quality.quick = 256;
  quality.depth = depth;
  const double expected = LayersAtNormal(index, depth);
  const Point point = Expect(expected, Layers(index, gap), quality, effort);
  // What the depth cuts off may be in a few paths only.
  return Named(series, WithRare(point, 1 - expected, 1));
}

constexpr double kGlassOfWater[] = {1, 1.5, 1.33, 1.5, 1};

std::vector<Point> ByDepth(double depth, const Effort& effort) {
  const double over_air[] = {1, 1.5, 1.33};
  const int events = static_cast<int>(depth);
  return {Stack("glass of water", kGlassOfWater, 0.1, events, effort),
          Stack("into water", over_air, 0.1, events, effort)};
}

std::vector<Point> ByGap(double gap, const Effort& effort) {
  return {Stack("glass of water", kGlassOfWater, gap, 1000, effort)};
}

std::vector<Point> ByLayers(double layers, const Effort& effort) {
  std::vector<double> index = {1};
  for (int i = 0; i < static_cast<int>(layers); ++i) index.push_back(i % 2 ? 1 : 1.5);
  return {Stack("", index, 0.01, 10000, effort)};
}

// A furnace with two spheres: one in the other, or side by side.
std::vector<Point> Nested(double gap, const Effort& effort) {
  Quality quality;
  quality.depth = 10000;
  const std::string view = ViewFrom({0, 0, 5}, 15) + Sky(1);
  const std::string glass = Dielectric(1.5);
  const std::string inside = Sphere({0, 0, 0}, 1 - gap, Dielectric(1.33 / 1.5));
  const std::string beside = Sphere({-0.5 - gap / 2, 0, 0}, 0.5, glass) +
                             Sphere({0.5 + gap / 2, 0, 0}, 0.5, glass);
  return {Named("water in glass",
                Expect(1, view + Sphere({0, 0, 0}, 1, glass) + inside, quality, effort)),
          Named("side by side", Expect(1, view + beside, quality, effort))};
}

}  // namespace

void AddGlassCases(std::vector<Case>& cases) {
  cases.push_back({"index-near-one", "materials",
                   "index of refraction 1 +- 1 to 1 +- 1e-7",
                   "glass neither darkens nor breaks: in a furnace a sphere and a thin "
                   "sheet show 1, a rough face what its integral is",
                   "Ignis #16", Truth::kClosedForm,
                   LogAxis("index - 1", "", 1e-7, 0.5, {1e-7, 1e-5, 1e-3, 0.1, 0.5},
                           Decades(-7, -0.5, 0.5)),
                   NearOne});
  cases.push_back({"index-large", "materials", "index of refraction from 1 to 100",
                   "in a furnace a sphere and a thin sheet show 1, a face R + T / eta^2",
                   "", Truth::kClosedForm,
                   LogAxis("index", "", 1, 100, Decades(0, 2), Decades(0, 2, 0.25)),
                   Large});
  cases.push_back({"glass-of-water-depth", "transport",
                   "glass, water and glass in layers, paths of 1 to 10000 events",
                   "as much light as a walk over the layers lets through",
                   "openmoonray #62", Truth::kTwin,
                   LogAxis("depth", "", 1, 1e4, {1, 3, 10, 32, 100, 1e4}), ByDepth});
  cases.push_back({"touching-faces", "transport",
                   "faces of glass and water 1 to 1e-7 apart",
                   "as much light as a walk over the layers lets through", "",
                   Truth::kTwin, LogAxis("gap", "", 1e-6, 1, Decades(-7, 0)), ByGap});
  cases.push_back(
      {"many-layers", "transport", "1 to 1000 faces of glass behind each other",
       "as much light as a walk over the layers lets through", "", Truth::kTwin,
       LogAxis("faces", "", 1, 1000, {1, 10, 100}, {1, 3, 10, 30, 100, 300, 1000}),
       ByLayers});
  cases.push_back(
      {"nested-glass", "transport",
       "spheres of glass that nest or touch, with gaps of 0.1 to 1e-7",
       "nothing is lost: a furnace shows 1", "", Truth::kClosedForm,
       LogAxis("gap", "radii", 1e-6, 0.1, Decades(-7, -1, 2), Decades(-7, -1)), Nested});
}

}  // namespace lanelight::stress
