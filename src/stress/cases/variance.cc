// Strategies that must take all of the variance away, or none of the mean.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "src/stress/cases/cases.h"
#include "src/stress/cases/points.h"
#include "src/stress/cases/scene_text.h"

namespace lanelight::stress {
namespace {

// A mean that is known without noise, and the noise that is left, which is to be none.
std::vector<Point> Exact(double expected, const std::string& text,
                         const std::string& strategy, const Effort& effort) {
  Point mean =
      Expect(expected, text,
             {.quick = 64, .full = 1024, .depth = 1, .strategy = strategy}, effort);
  Point noise = mean;
  noise.measured = std::exchange(mean.standard_error, 0) / expected;
  noise.expected = noise.standard_error = 0;
  noise.tolerance = 1e-6;
  noise.scale = 1;
  return {Named("mean", mean), Named("noise", noise)};
}

// The control variate is the integrand itself.
std::vector<Point> ByRadius(double radius, const Effort& effort) {
  const struct {
    const char *name, *control;
    double expected;
    std::string light;
  } kinds[] = {{"sphere", "analytic", 0.4,
                SphereLight({0.6, 0, 0.8}, radius, 1 / (radius * radius))},
               {"sky", "ambient", 0.5, Sky(1)}};
  std::vector<Point> points;
  for (const auto& [name, control, expected, light] : kinds) {
    const std::string strategy = fmt::format("control={},c=1,directions=light", control);
    for (const Point& point :
         Exact(expected, ViewOfPlane() + Plane(Diffuse(0.5)) + light, strategy, effort)) {
      points.push_back(Named(fmt::format("{}, {}", name, point.series), point));
    }
  }
  return points;
}

std::string Lamp(double x0, double x1) {
  return Block(Glow(1, true) + Rectangle({x0, -2, 0}, {x1, 2, 0}));
}

// One pixel, half of it a lamp: to one side of its middle (the pair of a sample is on the
// other side), or around its middle (it is on the same side), or aside by a little.
std::vector<Point> ByEdge(double aside, const Effort& effort) {
  std::vector<Point> points;
  for (const char* pairs : {"none", "antithetic:pixel", "antithetic:all"}) {
    Quality quality = {1024, 65536, 1, 1};
    quality.strategy = fmt::format("points=independent,pairs={}", pairs);
    const auto measure = [&](const char* name, double expected, const std::string& lamp) {
      points.push_back(
          Named(fmt::format("{}, {}", name, quality.strategy),
                Expect(expected, ViewOfPlane(1, 1) + lamp, quality, effort)));
    };
    measure("odd", (1 - aside) / 2, Lamp(-2, -aside));
    // Few samples fall between the edge and the middle, where pairs do not cancel.
    points.back() = WithRare(points.back(), aside, 1);
    measure("even", 0.5 - aside / 2, Lamp(-0.5 + aside / 2, 0.5 - aside / 2));
  }
  return points;
}

}  // namespace

void AddVarianceCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "sampling", Truth::kClosedForm};
  add({"control-without-variance",
       "control variates that are the integrand, for lights of radius 0.5 to "
       "1e-6 and a sky",
       "the mean is exact, and no noise is left",
       LogAxis("radius", "", {1e-6, 0.5}, {1e-6, 1e-4, 0.01, 0.1, 0.5}), ByRadius});
  add({"antithetic-edges",
       "edges in a pixel that are odd, even and neither to its middle",
       "pairs keep the mean, whatever they do to the variance",
       LogAxis("edge aside", "pixels", {1e-6, 0.5}, {1e-6, 1e-4, 0.01, 0.1, 0.5}),
       ByEdge});
}

}  // namespace lanelight::stress
