// `lanelight render` from the outside: what it writes, refuses and survives.
#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"
#include "tests/support/json.h"

namespace lanelight {
namespace {

using Catch::Contains;
using test::ReadJson;
namespace fs = std::filesystem;

bool SamePixels(const Image& a, const Image& b) {
  if (a.names != b.names || a.pixels.size() != b.pixels.size()) return false;
  return std::equal(
      a.pixels.begin(), a.pixels.end(), b.pixels.begin(),
      [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

}  // namespace

TEST_CASE("a render writes an image, a PNG and a report", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const std::string exr = directory / "out.exr", json = directory / "out.json";
  const ProcessResult r = RunLanelight(
      {"render", scene, "-o", exr, "--png", "--json", json, "--spp", "8", "-v"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains(exr) && Contains("out.png") && Contains("samples/s") &&
                        Contains("rays/s") && Contains("relative MSE") &&
                        Contains("all valid") && Contains("ns/item"));
  CHECK_THAT(r.err, Contains("100 %") && !Contains("\r"));

  const Image image = ReadExr(exr);
  CHECK(image.width == 32);
  CHECK(image.height == 24);
  for (const char* name : {"R", "G", "B", "variance.R", "variance.G", "variance.B"}) {
    CHECK(image.FindChannel(name) >= 0);
  }
  const int samples = image.FindChannel("samples");
  REQUIRE(samples >= 0);
  CHECK(image.At(0, 0, samples) == 8);
  CHECK(image.At(31, 23, samples) == 8);
  // The lit top of the sphere; the corner sees nothing.
  CHECK(image.At(16, 8, image.FindChannel("R")) > 0.01f);
  CHECK(image.At(0, 0, image.FindChannel("R")) == 0);
  CHECK(image.attributes.count("seed") == 1);
  CHECK(image.attributes.count("sceneHash") == 1);

  const nlohmann::json report = ReadJson(json);
  CHECK(report.at("schema") == 3);
  CHECK(report.at("samples") == 32 * 24 * 8);
  CHECK(report.at("rays").at("closest") >= 32 * 24 * 8);
  CHECK(report.at("health") ==
        nlohmann::json{{"nan", 0}, {"infinite", 0}, {"negative", 0}});
  CHECK(report.at("error").at("relmse").at("value") > 0);
  CHECK(report.at("error").at("effective_pixels") > 0);
  CHECK(report.at("stop_reason") == "samples");
  CHECK(report.at("seconds").at("render") > 0);
  CHECK(report.at("plan").at("stages").size() == report.at("stages").size());
  for (const auto& stage : report.at("stages")) {
    CHECK(stage.at("occupancy") <= 1);
    CHECK(stage.contains("ns_per_item"));
  }
}

TEST_CASE("command-line overrides replace the scene's settings", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), json = directory / "r.json";
  const ProcessResult r = RunLanelight({"render",       scene,
                                        "-o",           directory / "r.exr",
                                        "--json",       json,
                                        "--spp",        "3",
                                        "--resolution", "20x10",
                                        "--max-depth",  "2",
                                        "--seed",       "77",
                                        "--threads",    "1",
                                        "--sampler",    "sobol",
                                        "--wavefront",  "64",
                                        "--simd",       AvailableTargets().back(),
                                        "--quiet",      "--scattering",
                                        "uniform",      "--build",
                                        "fast"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  CHECK(r.out.empty());
  CHECK(r.err.empty());
  const nlohmann::json report = ReadJson(json), settings = report.at("settings");
  CHECK(settings.at("resolution") == nlohmann::json{20, 10});
  CHECK(settings.at("spp") == 3);
  CHECK(settings.at("build") == "fast");
  CHECK(settings.at("max_depth") == 2);
  CHECK(settings.at("seed") == 77);
  CHECK(settings.at("threads") == 1);
  CHECK(settings.at("sampler") == "sobol");
  CHECK(report.at("plan").at("wavefront") == 64);
  CHECK(report.at("target").at("name") == AvailableTargets().back());
  const auto features = report.at("plan").at("features");
  CHECK(std::count(features.begin(), features.end(), "DiffuseUniform") == 1);
}

TEST_CASE("a crop equals that part of the whole image", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const std::string whole = directory / "whole.exr", part = directory / "part.exr";
  REQUIRE(RunLanelight({"render", scene, "-o", whole, "--quiet"}).exit_code == kExitGood);
  REQUIRE(RunLanelight({"render", scene, "-o", part, "--quiet", "--crop", "10,4,25,20"})
              .exit_code == kExitGood);
  const Image a = ReadExr(whole), b = ReadExr(part);
  REQUIRE(b.width == 15);
  REQUIRE(b.height == 16);
  int different = 0;
  for (int y = 0; y < b.height; ++y) {
    for (int x = 0; x < b.width; ++x)
      different += b.At(x, y, 0) != a.At(x + 10, y + 4, 0);
  }
  CHECK(different == 0);
  const ProcessResult outside =
      RunLanelight({"render", scene, "-o", part, "--crop", "10,4,40,20"});
  CHECK(outside.exit_code == kExitBadInput);
  CHECK_THAT(outside.err, Contains("leaves the image of 32x24"));
}

TEST_CASE("equal seeds give equal pixels, other seeds different ones", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const auto render = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", scene, "-o", directory / name,
                                          "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    REQUIRE(RunLanelight(arguments).exit_code == kExitGood);
    return ReadExr(directory / name);
  };
  const Image base = render("a.exr", {"--seed", "5", "--threads", "1"});
  CHECK(SamePixels(base, render("b.exr", {"--seed", "5", "--threads", "2"})));
  CHECK(SamePixels(base, render("c.exr", {"--seed", "5", "--wavefront", "100"})));
  CHECK_FALSE(SamePixels(base, render("d.exr", {"--seed", "6"})));
}

TEST_CASE("auxiliary planes are written on request", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), exr = directory / "aov.exr";
  REQUIRE(RunLanelight({"render", scene, "-o", exr, "--aov", "--quiet"}).exit_code ==
          kExitGood);
  const Image image = ReadExr(exr);
  const int albedo = image.FindChannel("albedo.R"), depth = image.FindChannel("depth.Z");
  const int normal = image.FindChannel("normal.Z");
  REQUIRE((albedo >= 0 && depth >= 0 && normal >= 0));
  // The middle of the sphere of radius 1, seen from 5 units away.
  CHECK(image.At(16, 12, albedo) == Approx(0.5).epsilon(0.01));
  CHECK(image.At(16, 12, depth) == Approx(4).epsilon(0.02));
  CHECK(image.At(16, 12, normal) == Approx(-1).epsilon(0.02));
}

TEST_CASE("a result that cannot be written is saved elsewhere", "[cli]") {
  TempDirectory directory, temporary;
  const std::string scene = WriteSphereScene(directory), out = directory / "gone/o.exr";
  fs::create_directory(directory / "gone");
  ProcessOptions options;
  options.temp_directory = temporary.path();
  options.trigger = "rendering";
  options.action = [&](int) { fs::remove_all(directory / "gone"); };
  const ProcessResult r =
      RunLanelight({"render", scene, "-o", out, "--time", "1"}, options);
  INFO(r.err);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("gone/o.exr") && Contains("No such file or directory"));
  REQUIRE(temporary.Files().size() == 1);
  const std::string kept = temporary / temporary.Files().front();
  CHECK_THAT(r.err, Contains("written to '" + kept + "'"));
  CHECK(ReadExr(kept).width == 32);
}

TEST_CASE("a full disk is reported and no partial file remains", "[cli]") {
  TempDirectory directory, temporary;
  const std::string scene = WriteSphereScene(directory), out = directory / "o.exr";
  WriteText(out, "the old file");
  ProcessOptions options;
  options.temp_directory = temporary.path();
  options.prepare = [] {  // the signal of a file that may not grow ends programs
    signal(SIGXFSZ, SIG_DFL);
    const rlimit limit = {2000, 2000};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  const ProcessResult r = RunLanelight({"render", scene, "-o", out}, options);
  CHECK(r.signal == 0);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("o.exr") && Contains("it could not be written") &&
                        !Contains("error: error:") && !Contains("either: error:"));
  CHECK(temporary.Files().empty());
  CHECK(directory.Files() == std::vector<std::string>{"o.exr", "sphere.pbrt"});
  CHECK(fs::file_size(out) == 12);
}

TEST_CASE("absurd sizes are refused with numbers", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const ProcessResult r = RunLanelight(
      {"render", scene, "-o", directory / "big.exr", "--resolution", "65536x65536"});
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("65536x65536") && Contains("GiB"));
}

TEST_CASE(
    "a long render chooses a strategy by a trial run, reports it and resumes with it",
    "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), json = directory / "r.json";
  const std::string state = directory / "r.state";
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", scene,    "--resolution",
                                          "64x64",  "--json", json};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult r = RunLanelight(arguments);
    INFO(r.err);
    REQUIRE(r.exit_code == kExitGood);
    return ReadJson(json);
  };
  const auto decides = [](const nlohmann::json& report) {
    const std::string strategy = report["settings"]["strategy"];
    CHECK((report["pilot"]["changes"] != "") == (report["pilot"]["samples"] > 0));
    return strategy.find("decide=pilot") != std::string::npos;
  };
  const std::string exr = directory / "out.exr";
  CHECK_FALSE(decides(render({"-o", exr, "--spp", "2047"})));
  const nlohmann::json report = render({"-o", exr, "--spp", "2048"});
  CHECK(decides(report));
  CHECK(report["pilot"]["changes"] == "pixel-samples=shared,decide=none");
  CHECK_THAT(report["pilot"]["note"].get<std::string>(), Contains("roulette=adjoint"));
  // The image says what rendered it, not what was to be found out.
  CHECK_THAT(RunLanelight({"info", exr}).out,
             Contains("decide=none") && !Contains("decide=pilot"));
  CHECK_FALSE(
      decides(render({"-o", exr, "--spp", "2048", "--strategy", "points=sobol"})));
  // What is gone on with keeps what it began with, to more samples too.
  const auto kept = [&](const char* spp, std::vector<std::string> more) {
    more.insert(more.end(), {"-o", exr, "--checkpoint", state, "--resume", "--spp", spp});
    return render(more);
  };
  CHECK_FALSE(decides(kept("4", {})));
  CHECK_FALSE(decides(kept("2048", {})));
  fs::remove(state);
  CHECK(decides(kept("4", {"--strategy", "decide=pilot"})));
  CHECK(decides(kept("8", {})));
}

}  // namespace lanelight
