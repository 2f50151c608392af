// Long paths: closed rooms, depths, roulette, light behind many sheets.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

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

std::vector<Point> ByDepth(double depth, const Effort& effort) {
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

// Roulette ends paths with probability q: the weights 1 / (1 - q) keep the mean.
std::vector<Point> ByTermination(double q, const Effort& effort) {
  Quality quality = {256, 16384, 1000};
  quality.strategy = fmt::format("roulette=constant:{:.17g}:1", q);
  return {Expect(ClosedRoom(0.5, 0.5, 1000), Room(0.5, 0.5), quality, effort)};
}

std::vector<Point> ByFloor(double floor, const Effort& effort) {
  std::vector<Point> points;
  for (const char* kind : {"throughput", "luminance"}) {
    Quality quality = {256, 16384, 1000};
    quality.strategy = fmt::format("roulette={}:{:.17g}:1", kind, floor);
    points.push_back(
        Named(kind, Expect(ClosedRoom(0.5, 0.5, 1000), Room(0.5, 0.5), quality, effort)));
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
  point.failures = point.invalid;
  point.trials = point.samples;
  point.measured = double(point.failures) / double(point.trials);
  point.standard_error = 0;
  return {point};
}

}  // namespace

void AddTransportCases(std::vector<Case>& cases) {
  const CaseAdder closed{cases, "transport", Truth::kClosedForm};
  const CaseAdder rates{cases, "transport", Truth::kRate};
  closed({"path-sum", "paths of 40 to 1e6 events in a room that emits everywhere",
          "a path's sum is the geometric series, to 6e-8 of itself per event",
          LogAxis("1 - albedo", "", {1e-5, 0.5}, {1e-4, 1e-3, 1e-2, 0.1, 0.5},
                  {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5}),
          PathSum});
  closed(
      {"path-depth", "at most 1 to 1e4 events, albedo up to 1",
       "the geometric series ends with the depth",
       LogAxis("depth", "", {1, 1e6}, {1, 2, 32, 1000, 1e4}, {1, 2, 32, 1000, 1e4, 1e5}),
       ByDepth});
  closed({"roulette-constant",
          "roulette that ends 0.001 to 0.7 of the paths at each event",
          "a closed room keeps its balance",
          LogAxis("probability of ending", "", {1e-3, 0.7}, {1e-3, 0.01, 0.1, 0.5, 0.7}),
          ByTermination});
  closed({"roulette-floor", "least survival of 1e-6 to 1",
          "a closed room keeps its balance",
          LogAxis("least survival", "", {1e-6, 1}, {1e-6, 1e-3, 0.3, 0.6, 1}), ByFloor});
  closed({"behind-sheets", "a sky behind sheets that let 1 to 1e-30 of it through",
          "the product of what they let through",
          LogAxis("transmitted", "", {1e-30, 1}, Decades(-36, 0, 6), Decades(-36, 0, 2)),
          BehindSheets});
  rates({"invalid-samples",
         "many samples of glass, coats and metal in a room with a tiny lamp",
         "no sample is NaN, infinite or negative",
         LogAxis("samples", "", {0, 1e9}, {1 << 18}, {1 << 18, 1 << 22, 1 << 26}),
         NoInvalid, "pbrt-v4 #211"});
}

}  // namespace lanelight::stress
