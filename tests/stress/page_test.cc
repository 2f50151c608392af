// stress.json and the page hold what was measured.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/core/error.h"
#include "src/report/page.h"
#include "src/stress/efficiency.h"
#include "src/stress/stress_json.h"
#include "tests/image/temporary_folder.h"
#include "tests/stress/planted.h"

namespace lanelight::stress {
namespace {

using Json = nlohmann::json;

// A curve whose error grows with x, different for every curve.
Point Curve(const std::string& name, double x, int kind) {
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

Case Strategies() {
  return PlantedMap("strategies", [](double x) {
    if (x < 1e-3) throw InputError("<b>x</b> of 1e-4 is below \"1e-3\"");
    std::vector<Point> points;
    int kind = 0;
    for (const char* name : {"points=cmj", "points=sobol", "roulette=none"}) {
      points.push_back(Curve(name, x, kind++));
    }
    if (x == 1e-2) points[2].not_measured = "its light is too <i>rare</i>";
    return points;
  });
}

// One case of each kind, with texts that would be markup.
std::vector<Case> SyntheticCases() {
  std::vector<Case> cases = {Strategies()};
  cases.push_back(PlantedMap("shapes", [](double x) {
    return std::vector{Curve("<b>odd</b>", x, 0), Curve("disk", x, 0)};
  }));
  cases.push_back(PlantedMap("wrong-inside", [](double x) {
    return std::vector{Around1(x == 1e1 ? 1.2 : 1, 1e-3)};
  }));
  cases.push_back(
      PlantedMap("noisy", [](double) { return std::vector{Around1(1, 0.1)}; }));
  Case rate = PlantedMap("rare", [](double x) {
    Point point;
    point.expected = 1e-3;
    point.trials = 10000;
    point.failures = std::uint64_t(x > 1e2 ? x : x / 10);
    return std::vector{point};
  });
  rate.truth = Truth::kRate;
  cases.push_back(rate);
  Case angle =
      PlantedMap("angle", [](double x) { return std::vector{Curve("", 20 + x, 0)}; });
  angle.axis = {"angle", "degrees", false, 0, 180, {-10, 0, 45, 90, 180, 200}, {}};
  cases.push_back(angle);
  Case single =
      PlantedMap("single", [](double) { return std::vector{Around1(1, 1e-3)}; });
  single.axis = {};
  single.group = "others";
  cases.push_back(single);
  return cases;
}

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
  JudgeSuite(result);
  return result;
}

void CheckNumber(const Json& json, double x) {
  if (std::isfinite(x)) {
    CHECK(json.get<double>() == x);
  } else {
    CHECK(json.is_null());
  }
}

}  // namespace

TEST_CASE("stress: stress.json holds every number, to the last bit", "[stress]") {
  const SuiteResult result = SyntheticRun();
  const Json json = Json::parse(ToJson(result).dump());
  REQUIRE(json["cases"].size() == result.cases.size());
  CHECK(json["schema"] == 1);
  CHECK(json["outcomes"]["failed"] == 1);
  CHECK(json["cases"][0]["not_measured"] == 2);
  CHECK(json["promised"] == result.promised);
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    const CaseResult& one = result.cases[i];
    const Json& about = json["cases"][i];
    CHECK(about["name"] == one.about.name);
    CHECK(about["outcome"] == Name(one.outcome));
    CHECK(about["breaks"].size() == one.breaks.size());
    REQUIRE(about["points"].size() == one.points.size());
    for (std::size_t k = 0; k < one.points.size(); ++k) {
      const JudgedPoint& judged = one.points[k];
      const Json& point = about["points"][k];
      CheckNumber(point["parameter"], judged.point.parameter);
      CheckNumber(point["measured"], judged.point.measured);
      CheckNumber(point["expected"], judged.point.expected);
      CheckNumber(point["standard_error"], judged.point.standard_error);
      CheckNumber(point["degrees_of_freedom"], judged.point.degrees_of_freedom);
      CheckNumber(point["tolerance"], judged.point.tolerance);
      CheckNumber(point["seconds"], judged.point.seconds);
      CheckNumber(point["verdict"]["z"], judged.verdict.z);
      CheckNumber(point["verdict"]["allowance"], judged.verdict.allowance);
      CHECK(point["rays"] == judged.point.rays);
      CHECK(point["failures"] == judged.point.failures);
      CHECK(point["refused"] == judged.point.refused);
      CHECK(point["not_measured"] == judged.point.not_measured);
      CHECK(point["verdict"]["good"] == judged.verdict.good());
    }
  }
}

TEST_CASE("stress: strategies are compared with the default", "[stress]") {
  const SuiteResult result = SyntheticRun();
  const CaseResult& strategies = result.cases[0];
  CHECK(ComparesStrategies(strategies));
  CHECK_FALSE(ComparesStrategies(result.cases[1]));  // shapes
  CHECK_FALSE(ComparesStrategies(result.cases[2]));  // one curve
  CHECK(BaselineOf(strategies) == "points=sobol");   // which the default has
  for (const JudgedPoint& judged : strategies.points) {
    const auto ratio = RelativeEfficiency(strategies, judged);
    const Point& point = judged.point;
    CHECK(ratio.has_value() == (point.refused.empty() && point.not_measured.empty()));
    if (!ratio || point.series == "points=sobol") continue;
    const double x = point.parameter;
    const int kind = point.series == "points=cmj" ? 0 : 2;
    CHECK(ratio->value == Approx(Curve("", x, 1).seconds / Curve("", x, kind).seconds));
    // Two variances with 190 degrees of freedom each: F of 97.5 % is 1.330.
    CHECK(ratio->high / ratio->value == Approx(1.330).epsilon(2e-3));
    CHECK(ratio->low * ratio->high == Approx(ratio->value * ratio->value));
  }
}

TEST_CASE("stress: one sentence says what came out", "[stress]") {
  SuiteResult result = SyntheticRun();
  CHECK(Sentence(result) ==
        "1 of 7 cases fails on AVX3 and EMU128: wrong-inside; in 1 more some points "
        "are too noisy to say much.");
  result.cases.erase(result.cases.begin() + 2, result.cases.begin() + 4);
  CHECK(Sentence(result) == "All 5 cases are good on AVX3 and EMU128.");
  result.cases.resize(1);
  result.options.targets = {"AVX2"};
  CHECK(Sentence(result) == "The one case is good on AVX2.");
  result.cases.clear();
  CHECK(Sentence(result) == "There was no case to measure.");
}

TEST_CASE("stress: results are written whole", "[stress]") {
  const TemporaryFolder folder;
  const std::string dir = folder.File("a/b");
  WriteResults(SyntheticRun(), dir);
  std::ifstream in(dir + "/stress.json");
  CHECK(Json::parse(in)["cases"].size() == 7);
  CHECK(std::filesystem::file_size(dir + "/report.html") > 50'000);
  CHECK_THROWS_AS(WriteResults(SyntheticRun(), folder.Write("file", "") + "/x"),
                  InputError);
}

TEST_CASE("The synthetic stress page can be written", "[stress][report]") {
  const char* path = std::getenv("LANELIGHT_SYNTHETIC_STRESS");
  const std::string page = StressReportPage(ToJson(SyntheticRun()));
  CHECK(page.find("<b>odd") == std::string::npos);
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

}  // namespace lanelight::stress
