#include "tests/measure/stress/synthetic_run.h"

#include <cmath>

#include "src/base/core/error.h"
#include "tests/measure/stress/planted.h"

namespace lanelight::stress {

Point SwingingPoint(const std::string& name, double x, int kind) {
  const double wave = std::sin(3 * std::log(x) + kind);
  Point point = Around1(1 + 1e-3 * wave + (x > 1e3 ? 0.3 * kind : 0), 1e-3, 1e-4);
  point.series = name;
  point.degrees_of_freedom = 190;
  point.samples = 4096;
  point.rays = 4096 * (2 + kind) + std::uint64_t(100 * x);
  point.lanes_used = 900 - 100 * std::uint64_t(kind);
  point.lane_slots = 1000;
  point.seconds = 1e-3 * (1 + kind) * (2 + wave);
  return point;
}

namespace {

Case Strategies() {
  return PlantedMap("strategies", [](double x) {
    if (x < 1e-3) throw InputError("<b>x</b> of 1e-4 is below \"1e-3\"");
    std::vector<Point> points;
    int kind = 0;
    for (const char* name : {"points=halton", "points=sobol", "roulette=none"}) {
      points.push_back(SwingingPoint(name, x, kind++));
    }
    if (x == 1e-2) points[2].not_measured = "its light is too <i>rare</i>";
    return points;
  });
}

// One case of each kind, with texts that would be markup.
std::vector<Case> SyntheticCases() {
  std::vector<Case> cases = {Strategies()};
  cases.push_back(PlantedMap("shapes", [](double x) {
    return std::vector{SwingingPoint("<b>odd</b>", x, 0), SwingingPoint("disk", x, 0)};
  }));
  cases.push_back(PlantedMap("wrong-inside", [](double x) {
    return std::vector{Around1(x == 1e1 ? 1.2 : 1, 1e-3)};
  }));
  cases.push_back(
      PlantedMap("noisy", [](double) { return std::vector{Around1(1, 0.1)}; }));
  cases.push_back(PlantedMap("rare", [](double x) {
    return std::vector{Around1(1 + (x > 1e2 ? x / 1e4 : 0), 1e-5)};
  }));
  Case angle = PlantedMap(
      "angle", [](double x) { return std::vector{SwingingPoint("", 20 + x, 0)}; });
  angle.axis = {"angle", "degrees", false, 0, 180, {-10, 0, 45, 90, 180, 200}, {}};
  cases.push_back(angle);
  Case single =
      PlantedMap("single", [](double) { return std::vector{Around1(1, 1e-3)}; });
  single.axis = {};
  single.group = "others";
  cases.push_back(single);
  return cases;
}

}  // namespace

SuiteResult SyntheticRun() {
  SuiteResult result = RunSuite(SyntheticCases(), {});
  // As if there were two machines' worth of targets, and always the same times.
  for (CaseResult& one : result.cases) {
    for (JudgedPoint& judged : one.points) {
      judged.target = "AVX3";
      judged.total_seconds = 0.25;
    }
    const std::vector<JudgedPoint> first = one.points;
    for (JudgedPoint judged : first) {
      judged.target = "EMU128";
      judged.point.seconds *= 3;
      one.points.push_back(judged);
    }
  }
  result.options.targets = {"AVX3", "EMU128"};
  result.seconds = 12.5;
  result.machine = {};
  result.machine.processor = "<b>Synthetic</b>";
  result.machine.cores = 2;
  JudgeSuite(result);
  return result;
}

}  // namespace lanelight::stress
