// `lanelight plan` prints the stages of a scene and the omitted ones; `compare` sets exit
// codes.
#include <catch2/catch.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/base/image/exr.h"
#include "src/cli/exit_codes.h"
#include "src/vocabulary/path/features.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

bool Has(const nlohmann::json& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string WriteFlat(const std::string& path, float value, float variance) {
  std::vector<ExrPlane> planes;
  for (const char* name : {"R", "G", "B"}) {
    planes.push_back({name, std::vector<float>(16 * 16, value), false});
    planes.push_back(
        {std::string("variance.") + name, std::vector<float>(16 * 16, variance), true});
  }
  WriteExr(path, 16, 16, planes);
  return path;
}

}  // namespace

TEST_CASE("plan prints what runs; with -v omitted stages and fields with reasons",
          "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const ProcessResult brief = RunLanelight({"plan", scene});
  INFO(brief.err);
  REQUIRE(brief.exit_code == kExitGood);
  CHECK_THAT(brief.out, Contains("intersect_spheres") && Contains("bytes = ") &&
                            Contains("are omitted; -v lists them"));
  CHECK_THAT(brief.out, !Contains("no triangle"));
  CHECK(std::count(brief.out.begin(), brief.out.end(), '\n') < 60);
  const ProcessResult all = RunLanelight({"plan", scene, "-v"});
  CHECK_THAT(all.out, Contains("bytes per path") && Contains("omitted stages (") &&
                          Contains("omitted fields (") && Contains("no triangle"));
}

TEST_CASE("missing features of a scene are listed without articles", "[cli]") {
  for (int i = 0; i < static_cast<int>(Feature::kCount); ++i) {
    const std::string text = WithoutFeature(static_cast<Feature>(i));
    INFO(text);
    CHECK((text.starts_with("no ") || text.starts_with("not ")));
    for (const char* word : {"no a ", "no an ", "no the ", "no some", "no several "}) {
      CHECK_THAT(text, !Contains(word));
    }
    const std::string first = text.substr(0, text.find(' ', 4));
    CHECK(text.starts_with("not ") == (first.find('=') != text.npos));
  }
  CHECK(WithoutFeature(Feature::kOrthographic) == "no orthographic camera");
  CHECK(WithoutFeature(Feature::kHaltonSampleSequence) == "not points=halton");
}

TEST_CASE("the plan of a sphere under a point light has only what it needs", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const ProcessResult r = RunLanelight({"plan", scene, "--json"});
  REQUIRE(r.exit_code == kExitGood);
  const auto plan = nlohmann::json::parse(r.out).at("plan");
  CHECK(Has(plan.at("features"), "Spheres"));
  CHECK(Has(plan.at("features"), "PointLights"));
  CHECK_FALSE(Has(plan.at("features"), "Triangles"));
  CHECK_FALSE(Has(plan.at("features"), "Mis"));
  CHECK(Has(plan.at("fields"), "o_x"));
  CHECK(Has(plan.at("absent_fields"), "b1"));
  CHECK(Has(plan.at("absent_fields"), "uv_u"));
  CHECK(plan.at("bytes_per_path") == 4 * plan.at("fields").size());
  CHECK(plan.at("wavefront") > 0);
  CHECK_FALSE(plan.at("omitted_stages").empty());
  for (const auto& stage : plan.at("omitted_stages")) CHECK(stage.at("reason") != "");
}

TEST_CASE("depth and auxiliary output change the plan", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const auto features = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"plan", scene, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult r = RunLanelight(arguments);
    INFO(r.err);
    return nlohmann::json::parse(r.out).at("plan").at("features");
  };
  CHECK(Has(features({}), "Roulette"));
  CHECK_FALSE(Has(features({"--max-depth", "1"}), "Roulette"));
  CHECK_FALSE(Has(features({}), "Aov"));
  CHECK(Has(features({"--aov"}), "Aov"));
  CHECK_FALSE(Has(features({"--aov"}), "Gbuffer"));
  CHECK((Has(features({"--gbuffer", "world"}), "Aov") &&
         Has(features({"--gbuffer", "world"}), "Gbuffer")));
}

TEST_CASE("compare prints metrics and a verdict", "[cli]") {
  TempDirectory directory;
  const std::string a = WriteFlat(directory / "a.exr", 1, 0.01f);
  const std::string b = WriteFlat(directory / "b.exr", 1.1f, 0.01f);
  const ProcessResult same = RunLanelight({"compare", a, a, "--max-relmse", "0"});
  CHECK(same.exit_code == kExitGood);
  CHECK_THAT(same.out, Contains("RMSE           0\n"));
  const ProcessResult far = RunLanelight({"compare", a, b, "--max-relmse", "0.001"});
  CHECK(far.exit_code == kExitOverLimit);
  CHECK_THAT(far.err, Contains("over the limit"));
  CHECK(RunLanelight({"compare", a, b}).exit_code == kExitGood);

  const auto json = nlohmann::json::parse(RunLanelight({"compare", a, b, "--json"}).out);
  CHECK(json.at("mse").get<double>() == Approx(0.01).epsilon(1e-4));
  CHECK(json.at("z").at("mean").get<double>() ==
        Approx(-0.1 / std::sqrt(0.02)).epsilon(1e-3));
  const auto exact =
      nlohmann::json::parse(RunLanelight({"compare", a, b, "--json", "--reference"}).out);
  CHECK(exact.at("z").at("mean").get<double>() == Approx(-1).epsilon(1e-3));
}

}  // namespace lanelight
