// Strategies that must keep the mean.
#include <fmt/format.h>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"

namespace lanelight::stress {
namespace {

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
  add({"antithetic-edges",
       "edges in a pixel that are odd, even and neither to its middle",
       "pairs keep the mean, whatever they do to the variance",
       LogAxis("edge aside", "pixels", {1e-6, 0.5}, {1e-6, 1e-4, 0.01, 0.1, 0.5}),
       ByEdge});
}

}  // namespace lanelight::stress
