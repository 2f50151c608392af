// Roulette of any strength in a closed room.
#include <fmt/format.h>

#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

// Roulette ends paths with probability q: the weights 1 / (1 - q) keep the mean.
std::vector<Point> ByTermination(double q, const Effort& effort) {
  Quality quality = {256, 16384, 1000};
  quality.strategy = fmt::format("roulette=constant:{:.17g}:1", q);
  return {Expect(ClosedRoom(0.5, 0.5, 1000), Room(0.5, 0.5), quality, effort)};
}

std::vector<Point> ByFloor(double floor, const Effort& effort) {
  Quality quality = {256, 16384, 1000};
  quality.strategy = fmt::format("roulette=throughput:{:.17g}:1", floor);
  return {Expect(ClosedRoom(0.5, 0.5, 1000), Room(0.5, 0.5), quality, effort)};
}

}  // namespace

void AddTransportCases(std::vector<Case>& cases) {
  const CaseAdder closed{cases, "transport", Truth::kClosedForm};
  closed({"roulette-constant",
          "roulette that ends 0.001 to 0.7 of the paths at each event",
          "the radiance in a closed box is 1",
          LogAxis("probability of ending", "", {1e-3, 0.7}, {1e-3, 0.01, 0.1, 0.5, 0.7}),
          ByTermination});
  closed(
      {"roulette-floor", "minimum survival probability of 1e-6 to 1",
       "the radiance in a closed box is 1",
       LogAxis("minimum survival probability", "", {1e-6, 1}, {1e-6, 1e-3, 0.3, 0.6, 1}),
       ByFloor});
}

}  // namespace lanelight::stress
