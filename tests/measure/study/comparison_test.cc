// Efficiencies of a study with a budget: how far its sample counts can be trusted is in
// their intervals.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/measure/study/analysis.h"
#include "tests/base/stat/simulate.h"

namespace lanelight {
namespace {

// A strategy of 64 samples whose relative MSE falls like 1 / n^1.6 and scatters by 5 %.
StrategyAnalysis Simulated(double seconds, std::uint64_t seed) {
  reference::Random random(seed);
  StrategyAnalysis s;
  LevelAnalysis level;
  level.spp = 64;
  level.repetitions = 8;
  level.cpu_seconds = {seconds, seconds, seconds};
  s.levels.push_back(level);
  s.order_relmse = Interval{-0.8, -0.8, -0.8};
  stat::Level costs;
  costs.samples = 64;
  for (int i = 0; i < 8; ++i) {
    costs.error.push_back(0.01 * (1 + 0.05 * stat::Normal(random)));
    costs.seconds.push_back(seconds);
    s.trimmed.push_back({costs.error.back(), seconds});
  }
  s.costs.push_back(costs);
  return s;
}

struct Case {
  double spread = 0;   // of the second strategy's pilots
  double seconds = 1;  // that it took; the first took 1
  bool budget = true;
};

Interval EfficiencyOf(const Case& c) {
  SceneRuns runs;
  for (const char* name : {"first", "second"}) {
    runs.strategies.push_back({{name, {}}, RunStatus::kOk, "", {64}});
  }
  runs.strategies[1].count_deviation = c.spread;
  StudyOptions options;
  options.repetitions = 8;
  if (c.budget) options.budget = 1;
  SceneAnalysis analysis;
  analysis.strategies = {Simulated(1, 5), Simulated(c.seconds, 6)};
  CompareStrategies(runs, options, analysis);
  return *analysis.strategies[1].efficiency;
}

double LogWidth(const Interval& v) { return std::log(v.high / v.value); }

}  // namespace

TEST_CASE("the efficiency's interval includes the scatter of the budget's trial runs",
          "[study]") {
  const double plain = LogWidth(EfficiencyOf({}));
  const double spread = 0.2, sensitivity = 0.6;  // |1 - 2 x 0.8|
  const double more = stat::NormalQuantile(0.975) * spread * sensitivity;
  CHECK(LogWidth(EfficiencyOf({spread, 1, true})) == Approx(std::hypot(plain, more)));
  CHECK(LogWidth(EfficiencyOf({spread, 1, false})) == Approx(plain));
}

TEST_CASE("a missed budget widens the comparison's interval", "[study]") {
  const double plain = LogWidth(EfficiencyOf({}));
  // One of the two took ten times as long: equal time it was not.
  const Interval missed = EfficiencyOf({0, 10, true});
  const double more = stat::NormalQuantile(0.975) * std::log(10) * 0.6;
  CHECK(LogWidth(missed) == Approx(std::hypot(plain, more)));
  CHECK(missed.value == Approx(0.1).epsilon(0.1));
}

}  // namespace lanelight
