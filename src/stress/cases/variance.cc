// Strategies that must take all of the variance away, or none of the mean.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "src/stress/cases/cases.h"
#include "src/stress/cases/transport_setup.h"

namespace lanelight::stress {
namespace {

// A mean that is known without noise, and the noise that is left, which is to be none.
void AddExact(const std::string& series, double expected, const std::string& text,
              const std::string& strategy, const Effort& effort,
              std::vector<Point>& points) {
  Quality quality = {64, 1024, 1};
  quality.strategy = strategy;
  Point mean = Expect(expected, text, quality, effort), noise = mean;
  noise.measured = std::exchange(mean.standard_error, 0) / expected;
  noise.expected = noise.standard_error = 0;
  noise.tolerance = 1e-6;
  noise.scale = 1;
  points.push_back(Named(series + ", mean", mean));
  points.push_back(Named(series + ", noise", noise));
}

// The control variate is the integrand itself.
std::vector<Point> ByRadius(double radius, const Effort& effort) {
  std::vector<Point> points;
  const std::string view = ViewOfPlane() + Plane(Diffuse(0.5));
  AddExact("sphere", 0.4,
           view + SphereLight({0.6, 0, 0.8}, radius, 1 / (radius * radius)),
           "control=analytic,c=1,directions=light", effort, points);
  AddExact("sky", 0.5, view + Sky(1), "control=ambient,c=1,directions=light", effort,
           points);
  return points;
}

std::string Lamp(double x0, double x1) {
  return fmt::format(
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" "
      "true\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
      "[{0:.17g} -2 0 {1:.17g} -2 0 {1:.17g} 2 0 {0:.17g} 2 0]\nAttributeEnd\n",
      x0, x1);
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
  cases.push_back({"control-without-variance", "sampling",
                   "control variates that are the integrand, for lights of radius 0.5 to "
                   "1e-6 and a sky",
                   "the mean is exact, and no noise is left", "", Truth::kClosedForm,
                   LogAxis("radius", "", 1e-6, 0.5, {1e-6, 1e-4, 0.01, 0.1, 0.5}),
                   ByRadius});
  cases.push_back(
      {"antithetic-edges", "sampling",
       "edges in a pixel that are odd, even and neither to its middle",
       "pairs keep the mean, whatever they do to the variance", "", Truth::kClosedForm,
       LogAxis("edge aside", "pixels", 1e-6, 0.5, {1e-6, 1e-4, 0.01, 0.1, 0.5}), ByEdge});
}

}  // namespace lanelight::stress
