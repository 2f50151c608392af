// Runs of planted cases: what fails, what does not, and where a map breaks.
#include "src/measure/stress/suite.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <stdexcept>

#include "kernels/simd/target.h"
#include "src/base/core/error.h"
#include "src/cli/texts.h"
#include "tests/measure/stress/planted.h"

namespace lanelight::stress {
namespace {

CaseResult RunOne(const Case& planted) { return RunSuite({&planted, 1}, {}).cases.at(0); }

CaseResult RunMap(std::function<std::vector<Point>(double)> measure) {
  return RunOne(PlantedMap("map", std::move(measure)));
}

Point Series(std::string name, double measured) {
  Point point = Around1(measured);
  point.series = std::move(name);
  return point;
}

}  // namespace

TEST_CASE("stress: a good map is good, and every value is measured", "[stress]") {
  const CaseResult result = RunMap([](double) { return std::vector{Around1(1)}; });
  CHECK(result.outcome == Outcome::kGood);
  CHECK(result.points.size() == 9);
  CHECK(result.promised == 5);
  CHECK(result.breaks.empty());
  CHECK(result.points[3].point.parameter == 1e-1);
  CHECK(result.points[3].target == SimdTarget().name());
}

TEST_CASE("stress: planted faults inside the promise fail the case", "[stress]") {
  const auto plant = [](const std::function<Point()>& fault) {
    return RunMap([&](double x) { return std::vector{x == 1e1 ? fault() : Around1(1)}; });
  };
  const CaseResult biased = plant([] { return Around1(1.05, 0.008); });
  CHECK(biased.outcome == Outcome::kFailed);
  CHECK(biased.failed == 1);
  CHECK(biased.points[std::size_t(biased.worst)].point.parameter == 1e1);
  CHECK(biased.why == "off by +5 %");
  CHECK(plant([] { return Around1(std::nan("")); }).outcome == Outcome::kFailed);
  CHECK(plant([] { return Around1(1.1, 0, 0.09); }).outcome == Outcome::kFailed);
  const CaseResult refused = plant([]() -> Point { throw InputError("too large"); });
  CHECK(refused.outcome == Outcome::kFailed);
  CHECK(refused.why == "error: too large");
  const CaseResult crashed = plant([]() -> Point { throw std::runtime_error("oops"); });
  CHECK(crashed.outcome == Outcome::kFailed);
  CHECK(crashed.points[std::size_t(crashed.worst)].verdict.fault == Fault::kCrashed);
  CHECK(crashed.points.size() == 9);  // the others are measured all the same
  CHECK(plant([] { return Around1(1, 0.05); }).outcome == Outcome::kWeak);
}

TEST_CASE("stress: a case without a promised measurement fails", "[stress]") {
  CHECK(RunMap([](double) { return std::vector<Point>(); }).outcome == Outcome::kFailed);
  Case elsewhere =
      PlantedMap("elsewhere", [](double) { return std::vector{Around1(1)}; });
  elsewhere.axis.quick = {1e3, 1e4};
  const CaseResult result = RunOne(elsewhere);
  CHECK(result.outcome == Outcome::kFailed);
  CHECK(result.why == "no point in the supported range was measured");
}

TEST_CASE("stress: omitted points count neither as good nor as bad", "[stress]") {
  const auto leave_out = [](double x) {
    Point point = Around1(2);  // wrong, if it counted
    point.not_measured = "too rare";
    return std::vector{x == 1 || x > 1e3 ? point : Around1(1)};
  };
  const CaseResult some = RunMap(leave_out);
  CHECK(some.outcome == Outcome::kGood);
  CHECK(some.promised == 4);
  CHECK(some.not_measured == 2);
  CHECK(some.breaks.empty());
  Case none = PlantedMap("none", leave_out);
  none.axis.quick = {1};
  CHECK(RunOne(none).outcome == Outcome::kFailed);
}

TEST_CASE("stress: the limit of a map is the first wrong point going outward",
          "[stress]") {
  const CaseResult result = RunMap([](double x) {
    Point refused;
    refused.refused = "too small";
    refused.series = "b";
    // a breaks above, from 1e3 on; b is refused below, at the very end.
    return std::vector{Series("a", x >= 1e3 ? 2 : 1),
                       x < 1e-3 ? refused : Series("b", 1)};
  });
  CHECK(result.outcome == Outcome::kGood);
  REQUIRE(result.breaks.size() == 2);
  CHECK(result.breaks[0].series == "a");
  CHECK(result.breaks[0].above);
  CHECK(result.breaks[0].parameter == 1e3);
  CHECK(result.breaks[0].fault == Fault::kOff);
  CHECK(result.breaks[1].series == "b");
  CHECK_FALSE(result.breaks[1].above);
  CHECK(result.breaks[1].parameter == 1e-4);
  CHECK(result.breaks[1].why == "too small");
}

TEST_CASE("stress: a thrown refusal breaks every curve of the map", "[stress]") {
  const CaseResult result = RunMap([](double x) {
    if (x > 1e3) throw InputError("too large");
    return std::vector{Series("a", 1), Series("b", 1)};
  });
  CHECK(result.outcome == Outcome::kGood);
  REQUIRE(result.breaks.size() == 2);
  CHECK(result.breaks[0].parameter == 1e4);
  CHECK(result.breaks[1].fault == Fault::kRefused);
}

TEST_CASE("stress: every SIMD target is measured", "[stress]") {
  SuiteOptions options;
  options.targets = AvailableTargets();
  std::vector<std::string> seen;
  Case planted = PlantedMap("targets", {});
  planted.measure = [&](double, const Effort& effort) {
    seen.push_back(effort.target.name());
    return std::vector{Around1(1)};
  };
  planted.axis.quick = {1};
  const SuiteResult result = RunSuite({&planted, 1}, options);
  CHECK(seen == AvailableTargets());
  CHECK(result.cases[0].points.back().target == AvailableTargets().back());
  options.targets = {"AVX9000"};
  CHECK_THROWS_AS(RunSuite({&planted, 1}, options), InputError);
}

TEST_CASE("stress: a stop keeps finished measurements", "[stress]") {
  std::atomic<bool> stop = false;
  const auto good = [](double) { return std::vector{Around1(1)}; };
  const auto stopping = [&](double x) {
    if (x == 1) stop = true;
    return std::vector{Around1(1)};
  };
  const std::vector<Case> cases = {PlantedMap("first", good),
                                   PlantedMap("second", stopping),
                                   PlantedMap("third", good)};
  SuiteHooks hooks;
  hooks.stop = &stop;
  std::size_t reports = 0;
  hooks.on_progress = [&](const SuiteProgress& p) { CHECK(p.done == reports++); };
  const SuiteResult result = RunSuite(cases, {}, hooks);
  CHECK(result.interrupted);
  CHECK(reports == 14);
  CHECK(result.cases[0].outcome == Outcome::kGood);
  CHECK(result.cases[1].outcome == Outcome::kUnfinished);
  CHECK(result.cases[1].points.size() == 5);  // the point in hand was finished
  CHECK(result.cases[2].points.empty());
  CHECK(ExitCodeOf(result) == kExitInterrupted);
}

TEST_CASE("stress: exit codes", "[stress]") {
  const Case good = PlantedMap("good", [](double) { return std::vector{Around1(1)}; });
  const Case bad = PlantedMap("bad", [](double) { return std::vector{Around1(2)}; });
  const Case weak = PlantedMap("weak", [](double) { return std::vector{Around1(1, 1)}; });
  CHECK(ExitCodeOf(RunSuite({&good, 1}, {})) == kExitGood);
  CHECK(ExitCodeOf(RunSuite({&weak, 1}, {})) == kExitGood);
  const std::vector<Case> both = {good, bad};
  CHECK(ExitCodeOf(RunSuite(both, {})) == kExitStressFailed);
  CHECK(static_cast<int>(kExitStressFailed) == 7);
}

TEST_CASE("stress: full values replace the quick ones where there are any", "[stress]") {
  Case planted = PlantedMap("full", [](double) { return std::vector{Around1(1)}; });
  CHECK(ValuesOf(planted, true) == planted.axis.quick);
  planted.axis.full = {1, 2};
  CHECK(ValuesOf(planted, true) == planted.axis.full);
  planted.axis.quick.clear();
  CHECK(ValuesOf(planted, false).size() == 1);
  CHECK(std::isnan(ValuesOf(planted, false)[0]));
}

// 4000 correct runs of 40 points, with noise that is estimated from 5 values each and a
// mean at the very end of its tolerance. With probability 1e-6 the count is further than
// 4.9 standard deviations above the 5 % asked for.
TEST_CASE("stress: correct runs fail with the stated probability", "[stress]") {
  constexpr int kRuns = 4000, kPoints = 40, kValues = 5;
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(1.003, 0.02);
  int failed = 0;
  for (int run = 0; run < kRuns; ++run) {
    SuiteResult result;
    result.options.false_alarm = 0.05;
    result.cases.resize(1);
    result.cases[0].finished = true;
    for (int i = 0; i < kPoints; ++i) {
      double sum = 0, squares = 0;
      for (int k = 0; k < kValues; ++k) {
        const double x = noise(random);
        sum += x, squares += x * x;
      }
      const double mean = sum / kValues;
      const double variance = (squares - sum * mean) / (kValues - 1);
      Point point = Around1(mean, std::sqrt(variance / kValues), 0.003);
      point.degrees_of_freedom = kValues - 1;
      JudgedPoint& judged = result.cases[0].points.emplace_back();
      judged.point = point;
      judged.promised = true;
    }
    JudgeSuite(result);
    failed += result.cases[0].outcome == Outcome::kFailed;
  }
  const double maximum = 0.05 * kRuns;
  CHECK(failed < maximum + 4.9 * std::sqrt(maximum * 0.95));
  CHECK(failed > 0.01 * kRuns);  // and the test is not useless: half of it is used
}

}  // namespace lanelight::stress
