// `lanelight render --target-relmse` and `--target-rmse` from the outside.
#include <catch2/catch.hpp>
#include <signal.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/image/exr.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

struct Outcome {
  ProcessResult process;
  nlohmann::json report;
  Image image;
};

Outcome Render(std::vector<std::string> flags) {
  TempDirectory directory;
  const std::string exr = directory / "out.exr", json = directory / "out.json";
  std::vector<std::string> arguments = {
      "render", WriteSphereScene(directory), "-o", exr, "--json", json};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  Outcome out;
  out.process = RunLanelight(arguments);
  INFO(out.process.err);
  std::ifstream in(json);
  REQUIRE(in);
  out.report = nlohmann::json::parse(in);
  out.image = ReadExr(exr);
  return out;
}

}  // namespace

TEST_CASE("a reached error target exits with 0", "[cli]") {
  const Outcome o = Render({"--target-relmse", "0.001"});
  CHECK(o.process.exit_code == kExitGood);
  CHECK(o.report.at("stop_reason") == "target");
  CHECK(o.report.at("stopped_early") == false);
  CHECK(o.report.at("error").at("relmse").at("high") < 0.001);
  CHECK(o.report.at("settings").at("target_relmse") == 0.001);
  CHECK(o.report.at("settings").at("target_rmse").is_null());
  CHECK(o.report.at("looks") >= 1);
  CHECK_THAT(o.process.out, Contains("target reached"));
  const Outcome rmse = Render({"--target-rmse", "0.05", "--target-relmse", "0.1"});
  CHECK(rmse.process.exit_code == kExitGood);
  CHECK(rmse.report.at("error").at("rmse").at("high") < 0.05);
}

TEST_CASE("a target that is not reached exits with 5, and the image is there", "[cli]") {
  const Outcome few = Render({"--target-relmse", "1e-9", "--spp", "20"});
  CHECK(few.process.exit_code == kExitTargetMissed);
  CHECK_THAT(few.process.err, Contains("target was not reached") && Contains("--spp"));
  CHECK(few.report.at("stop_reason") == "samples");
  CHECK(few.report.at("samples") == 20 * 32 * 24);
  CHECK(few.image.width == 32);
  const Outcome late =
      Render({"--target-rmse", "1e-9", "--time", "0.2", "--spp", "100000000"});
  CHECK(late.process.exit_code == kExitTargetMissed);
  CHECK(late.report.at("stop_reason") == "time");
  CHECK_THAT(late.process.err, Contains("--time"));
  // Even quietly: this is an error.
  const Outcome quiet = Render({"--target-relmse", "1e-9", "--spp", "16", "--quiet"});
  CHECK(quiet.process.exit_code == kExitTargetMissed);
  CHECK_THAT(quiet.process.err, Contains("target was not reached"));
}

TEST_CASE("an error target that no number of samples can verify ends the render",
          "[cli]") {
  // A lamp too small to be hit: samples cannot show what the image lacks.
  TempDirectory directory;
  const std::string scene = directory / "dot.pbrt", json = directory / "dot.json";
  std::ofstream(scene) << R"(
LookAt 0 0 -6  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Translate 0.2 0.2 0
  Shape "sphere" "float radius" 0.0003
AttributeEnd
)";
  const ProcessResult r =
      RunLanelight({"render", scene, "-o", directory / "dot.exr", "--json", json,
                    "--target-relmse", "0.1", "--strategy", "seen-lights=paths"});
  CHECK(r.exit_code == kExitTargetMissed);
  CHECK_THAT(r.err, Contains("more samples will not help") &&
                        Contains("samples per pixel") &&
                        Contains("unknown: every sample is black") &&
                        Contains("warning: no light reached the image"));
  std::ifstream in(json);
  CHECK(nlohmann::json::parse(in).at("stop_reason") == "hopeless");
  CHECK(ReadExr(directory / "dot.exr").width == 16);
  // An image of another render is kept.
  const ProcessResult other =
      RunLanelight({"render", scene, "-o", directory / "dot.exr", "--seed", "2",
                    "--target-relmse", "0.1", "--strategy", "seen-lights=paths"});
  CHECK(other.exit_code == kExitInterrupted);
  CHECK_THAT(other.err, Contains("more samples will not help") &&
                            Contains("dot.partial.exr") && Contains("is unchanged"));
}

TEST_CASE("an interrupted render misses its target", "[cli]") {
  TempDirectory directory;
  ProcessOptions interrupt;
  interrupt.trigger = "rendering";
  interrupt.action = [](int child) { kill(child, SIGINT); };
  const std::string exr = directory / "out.exr";
  const ProcessResult r =
      RunLanelight({"render", WriteSphereScene(directory), "-o", exr, "--target-relmse",
                    "1e-12", "--resolution", "640x480", "--spp", "400"},
                   interrupt);
  CHECK(r.exit_code == kExitTargetMissed);
  CHECK_THAT(r.err, Contains("interruption"));
  CHECK(ReadExr(exr).width == 640);
}

TEST_CASE("a render that ends by its time budget says so", "[cli]") {
  const Outcome o = Render({"--time", "0.1"});
  CHECK(o.process.exit_code == kExitGood);
  CHECK(o.report.at("stop_reason") == "time");
  CHECK(o.report.at("settings").at("time_budget") == 0.1);
  CHECK(o.report.at("settings").at("spp").is_null());
  CHECK(o.report.at("samples") > 32 * 24);
  CHECK_FALSE(o.report.at("error").is_null());
}

}  // namespace lanelight
