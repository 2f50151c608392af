// Long paths: closed rooms, sheets, faces of glass, and samples that must be numbers.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "src/measure/stress/closed_forms.h"
#include "tests/extremes/check_points.h"

namespace lanelight::stress {
namespace {

// Without light samples and roulette, every path of a room in which everything emits has
// the same value: what is off is the path's own sum.
std::vector<Point> PathSum(double missing, const Effort& effort) {
  const double albedo = 1 - missing;
  const int depth = static_cast<int>(std::min(1e6, std::ceil(20 / missing)));
  Quality quality = {1, 4, depth, 4};
  quality.strategy = "directions=bsdf,roulette=none,points=independent";
  Point point = Expect(ClosedRoom(0.1, double(float(albedo)), depth), Room(0.1, albedo),
                       quality, effort);
  // Each of 1 / (1 - albedo) events rounds the sum once (docs/numbers.md).
  point.tolerance += 0x1p-24 / missing * point.expected;
  point.standard_error = 0;  // all paths are equal; one of each pixel shows no scatter
  return {point};
}

std::vector<Point> BySumOfEvents(double depth, const Effort& effort) {
  std::vector<Point> points;
  for (double albedo : {0.5, 0.999, 1.0}) {
    Quality quality = {4, 64, static_cast<int>(depth), 4};
    quality.strategy = "directions=bsdf,roulette=none,points=independent";
    Point point = Expect(ClosedRoom(1, double(float(albedo)), depth), Room(1, albedo),
                         quality, effort);
    point.tolerance += 0x1p-24 * std::min(depth, 1000.0) * point.expected;
    points.push_back(Named(fmt::format("albedo {}", albedo), point));
  }
  return points;
}

std::vector<Point> BehindSheets(double transmitted, const Effort& effort) {
  Quality quality = {16, 256, 200};
  quality.strategy = "roulette=none";
  return {Expect(transmitted, Sheets(transmitted), quality, effort)};
}

// What Sample and Eval of every rough or random material give in a room of them, many
// times: no sample may be invalid.
std::vector<Point> NoInvalid(double samples, const Effort& effort) {
  const std::string glass = Glass(1.5, 0.05);
  const std::string text =
      ViewFrom({0, 0, 3.9}, 60) + Walls(1, 0.8) + Sphere({-1, -1, 0}, 1, glass) +
      Sphere({1, -1, 0}, 1, "\"coateddiffuse\" \"float roughness\" 0.001") +
      Sphere({-1, 1, 0}, 1, "\"coatedconductor\"") +
      Sphere({1, 1, 0}, 1, "\"conductor\" \"float roughness\" 1e-4") +
      Sphere({0, 0, 1.5}, 0.4, glass) + SphereLight({0, 0, -1}, 1e-4, 1e6);
  SceneText scene = Setup(text, {1, 1, 32, 16}, effort);
  scene.settings.spp = static_cast<std::uint64_t>(samples) / 256;
  Point point = MeanOf(RenderText(scene));
  point.expected = point.measured;
  return {point};
}

std::string ThinGlass(double eta) {
  return fmt::format("\"thindielectric\" \"float eta\" {:.17g}", eta);
}

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

// Radiance 1 from above or below that a stack of parallel faces returns at normal
// incidence: `index[i]` lies between face i-1 and face i (index[0] above all). Traces
// all paths of at most `depth` faces as a walk over the layers.
double LayersAtNormal(std::span<const double> index, int depth) {
  const int faces = static_cast<int>(index.size()) - 1;
  // Importance that heads down to face i, and up to it.
  std::vector<double> down(faces + 1), up(faces + 1);
  down[0] = 1;
  double arrived = 0;
  for (int event = 0; event < depth; ++event) {
    std::vector<double> next_down(faces + 1), next_up(faces + 1);
    for (int i = 0; i < faces; ++i) {
      const double a = index[i], b = index[i + 1];
      const double amplitude = (a - b) / (a + b), r = amplitude * amplitude;
      // Radiance is spread by the square of the index: to go from a to b, (a / b)^2.
      const double below = down[i] * (1 - r) * (a / b) * (a / b) + up[i] * r;
      const double above = up[i] * (1 - r) * (b / a) * (b / a) + down[i] * r;
      (i + 1 < faces ? next_down[i + 1] : arrived) += below;
      (i > 0 ? next_up[i - 1] : arrived) += above;
    }
    down = std::move(next_down);
    up = std::move(next_up);
  }
  return arrived;
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
  // The light beyond the maximum depth may be carried by few paths.
  return AllowForRareSamples(
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

TEST_CASE("extremes: sums of paths of up to 2e5 events") {
  CheckPoints({1e-4, 1e-3, 1e-2, 0.1, 0.5}, PathSum);
}
TEST_CASE("extremes: the series of a closed room ends with the depth") {
  CheckPoints({1, 2, 32, 1000, 1e4}, BySumOfEvents);
}
TEST_CASE("extremes: a sky behind sheets that let 1 to 1e-30 of it through") {
  CheckPoints(Decades(-30, 0, 6), BehindSheets);
}
// pbrt-v4 #211.
TEST_CASE("extremes: 260 000 samples of rough materials are finite") {
  CheckPoints({1 << 18}, NoInvalid);
}
// Ignis #16.
TEST_CASE("extremes: indices of refraction of 1 +- 0.5 to 1 +- 1e-7 lose no light") {
  CheckPoints({1e-7, 1e-5, 1e-3, 0.1, 0.5}, NearOne);
}
TEST_CASE("extremes: indices of refraction of 1 to 100 lose no light") {
  CheckPoints(Decades(0, 2), Large);
}
TEST_CASE("extremes: the random walk over layers has the expected limits") {
  const double slab[] = {1, 1.5, 1};
  CHECK(LayersAtNormal(slab, 1000) == Approx(1).epsilon(1e-12));
  // Two events: off the upper face at once, or through both.
  const double r = 0.04, t = 1 - r;
  CHECK(LayersAtNormal(slab, 2) == Approx(r + t * t).epsilon(1e-12));
  CHECK(LayersAtNormal(slab, 1) == Approx(r).epsilon(1e-12));
}
// openmoonray #62.
TEST_CASE("extremes: glass, water and glass, in paths of 1 to 10 000 events") {
  CheckPoints({1, 3, 10, 32, 100, 1e4}, ByDepth);
}
TEST_CASE("extremes: faces of glass and water 1 to 1e-6 apart") {
  CheckPoints(Decades(-6, 0), ByGap);
}
TEST_CASE("extremes: 1 to 100 faces of glass behind each other") {
  CheckPoints({1, 10, 100}, ByLayers);
}
TEST_CASE("extremes: spheres of glass that nest or touch, with gaps of 0.1 to 1e-6") {
  CheckPoints({1e-5, 1e-3, 1e-1}, Nested);
}

}  // namespace lanelight::stress
