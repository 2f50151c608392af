// `lanelight advise` from the outside.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/cli/exit_codes.h"
#include "src/render/job/report.h"
#include "tests/cli/process.h"
#include "tests/support/json.h"

namespace lanelight {
namespace {

using Catch::Contains;
using test::ReadJson;

const std::string kBox = std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt";

const nlohmann::json& Find(const nlohmann::json& advice, const std::string& changes) {
  for (const auto& c : advice.at("candidates")) {
    if (c.at("changes") == changes) return c;
  }
  FAIL("no candidate " << changes);
  return advice;
}

}  // namespace

TEST_CASE("advise renders with the advised strategy and reports the reason", "[cli]") {
  TempDirectory directory;
  const std::string exr = directory / "out.exr", json = directory / "out.json";
  const ProcessResult r =
      RunLanelight({"advise", kBox, "--time", "2.5", "--pilot", "0.3", "--resolution",
                    "64x64", "-o", exr, "--json", json});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("roulette=none") && Contains("advice") &&
                        Contains("95 % confidence") && Contains("(the default)"));
  const Image image = ReadExr(exr);
  CHECK(image.width == 64);

  const nlohmann::json report = ReadJson(json), advice = report.at("advice");
  CHECK(report.at("settings").at("strategy") == advice.at("chosen"));
  CHECK(report.at("error").at("relmse").at("value") > 0);
  CHECK(advice.at("pilot_seconds") > 0);
  CHECK(report.at("settings").at("time_budget").get<double>() +
            advice.at("pilot_seconds").get<double>() ==
        Approx(2.5).epsilon(1e-6));
  CHECK_FALSE(advice.at("why").get<std::string>().empty());
  CHECK(advice.at("interrupted") == false);
  CHECK(Find(advice, "").at("strategy").get<std::string>().find("points=sobol") <
        std::string::npos);
  const nlohmann::json& refused = Find(advice, "light-selection=tree");
  CHECK(refused.at("status") == "refused");
  CHECK(refused.at("efficiency") == nullptr);
  CHECK_THAT(refused.at("reason").get<std::string>(), Contains("little to select"));
  int chosen = 0;
  for (const auto& c : advice.at("candidates")) {
    if (c.at("status") != "chosen") continue;
    ++chosen;
    CHECK(c.at("strategy") == advice.at("chosen"));
  }
  CHECK(chosen == 1);
}

TEST_CASE("advise without an image prints the command that renders", "[cli]") {
  const ProcessResult r =
      RunLanelight({"advise", kBox, "--time", "0.5", "--resolution", "32x32"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("lanelight render") && Contains("--time 0.5") &&
                        Contains("--strategy directions="));
  const ProcessResult json = RunLanelight(
      {"advise", kBox, "--time", "0.5", "--resolution", "32x32", "--json", "-"});
  REQUIRE(json.exit_code == kExitGood);
  const nlohmann::json report = nlohmann::json::parse(json.out);
  CHECK(report.at("schema") == kReportSchema);
  CHECK(report.at("advice").at("candidates").size() >= 5);
}

TEST_CASE("the command that advise prints repeats the given flags", "[cli]") {
  TempDirectory directory;
  const std::string scene = directory / "it's a sphere.pbrt";
  std::filesystem::rename(WriteSphereScene(directory), scene);
  const ProcessResult r = RunLanelight({"advise",
                                        scene,
                                        "--time",
                                        "0.3",
                                        "--resolution",
                                        "32x24",
                                        "--crop",
                                        "0,0,16,16",
                                        "--aov",
                                        "--max-depth",
                                        "3",
                                        "--seed",
                                        "7",
                                        "--threads",
                                        "1",
                                        "--build",
                                        "fast",
                                        "--scattering",
                                        "uniform",
                                        "--copied-triangles",
                                        "0",
                                        "--wavefront",
                                        "512"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("it'\\''s a sphere.pbrt' -o FILE.exr --time 0.3 "));
  CHECK_THAT(r.out,
             Contains(" --time 0.3 --seed 7 --resolution 32x24 --crop 0,0,16,16 --aov "
                      "--strategy directions="));
  CHECK_THAT(r.out,
             Contains(" --max-depth 3 --scattering uniform --wavefront 512 --build fast "
                      "--copied-triangles 0 --threads 1\n"));
}

TEST_CASE("advise refuses flags without effect", "[cli]") {
  CHECK(RunLanelight({"advise", kBox}).exit_code == kExitUsage);
  CHECK(RunLanelight({"advise", kBox, "--time", "0"}).exit_code == kExitUsage);
  const ProcessResult png = RunLanelight({"advise", kBox, "--time", "1", "--png"});
  CHECK(png.exit_code == kExitUsage);
  CHECK_THAT(png.err, Contains("-o FILE.exr"));
  const ProcessResult pilot =
      RunLanelight({"advise", kBox, "--time", "30ms", "--pilot", "1h"});
  CHECK(pilot.exit_code == kExitBadInput);
  CHECK_THAT(pilot.err, Contains("longer than --time 30 ms"));
}

}  // namespace lanelight
