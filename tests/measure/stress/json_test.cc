// stress.json holds what was measured, and is documented.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "src/base/core/input_file.h"
#include "src/measure/stress/efficiency.h"
#include "src/measure/stress/stress_json.h"
#include "src/render/job/machine_json.h"
#include "tests/measure/stress/synthetic_run.h"

namespace lanelight::stress {
namespace {

using Json = nlohmann::json;

void CollectMembers(const Json& json, std::set<std::string>& members) {
  for (const auto& [key, value] : json.items()) {
    if (json.is_object()) members.insert(key);
    if (value.is_structured()) CollectMembers(value, members);
  }
}

void CheckNumber(const Json& json, double x) {
  if (std::isfinite(x)) {
    CHECK(json.get<double>() == x);
  } else {
    CHECK(json.is_null());
  }
}

}  // namespace

TEST_CASE("stress: stress.json contains every value exactly", "[stress]") {
  const SuiteResult result = SyntheticRun();
  const Json json = Json::parse(ToJson(result).dump());
  REQUIRE(json["cases"].size() == result.cases.size());
  CHECK(json["schema"] == 2);
  CHECK(json["machine"] == lanelight::ToJson(result.machine));
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
      CHECK(point["refused"] == judged.point.refused);
      CHECK(point["not_measured"] == judged.point.not_measured);
      CHECK(point["verdict"]["good"] == judged.verdict.good());
    }
  }
}

TEST_CASE("stress: docs/stress.md names every member of stress.json", "[stress]") {
  const std::string doc =
      ReadWholeFile(std::string(LANELIGHT_SOURCE_DIR) + "/docs/stress.md");
  const std::string table = doc.substr(doc.find("## stress.json"));
  std::set<std::string> members;
  CollectMembers(ToJson(SyntheticRun()), members);
  CHECK(members.size() > 60);
  for (const std::string& member : members) {
    INFO(member);
    const std::regex word("[.{,`]" + member + "[.},`\\[]");
    CHECK(std::regex_search(table, word));
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
    const int kind = point.series == "points=halton" ? 0 : 2;
    CHECK(ratio->value ==
          Approx(SwingingPoint("", x, 1).seconds / SwingingPoint("", x, kind).seconds));
    // Two variances with 190 degrees of freedom each: F of 97.5 % is 1.330.
    CHECK(ratio->high / ratio->value == Approx(1.330).epsilon(2e-3));
    CHECK(ratio->low * ratio->high == Approx(ratio->value * ratio->value));
  }
}

}  // namespace lanelight::stress
