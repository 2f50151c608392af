// An interrupted render replaces an image only by one of the same render with more
// samples.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"
#include "tests/support/json.h"

namespace lanelight {
namespace {

using Catch::Matchers::Contains;

std::string BytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

// A closed room of long paths: a pass over an image of a million pixels takes ten seconds
// of processor time, and few samples end an interrupted one.
std::string WriteSlowScene(const TempDirectory& directory) {
  return WriteText(directory / "room.pbrt", R"(
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
Sampler "independent"
Integrator "path" "integer maxdepth" 1000
WorldBegin
LightSource "point" "rgb I" [1 1 1]
Material "diffuse" "rgb reflectance" [0.99 0.99 0.99]
Shape "sphere" "float radius" 2
)");
}
constexpr int kSlowWidth = 1200, kSlowHeight = 800;
const std::string kSlowResolution = fmt::format("{}x{}", kSlowWidth, kSlowHeight);
constexpr const char* kLongPaths = "roulette=none,decide=none";

ProcessResult InterruptAt(const std::string& trigger, int number,
                          const std::vector<std::string>& arguments) {
  ProcessOptions interrupt;
  interrupt.trigger = trigger;
  interrupt.action = [number](int child) { kill(child, number); };
  return RunLanelight(arguments, interrupt);
}

}  // namespace

TEST_CASE("an interruption before the first pass ends keeps the image", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSlowScene(directory), exr = directory / "keep.exr";
  REQUIRE(RunLanelight({"render", scene, "-o", exr, "--spp", "4"}).exit_code ==
          kExitGood);
  const std::string before = BytesOf(exr);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    INFO("signal " << number);
    const ProcessResult r =
        InterruptAt("rendering", number,
                    {"render", scene, "-o", exr, "--png", "--spp", "1", "--resolution",
                     kSlowResolution, "--strategy", kLongPaths});
    INFO(r.err);
    CHECK(r.exit_code == kExitInterrupted);
    CHECK(BytesOf(exr) == before);
    CHECK_FALSE(std::filesystem::exists(directory / "keep.png"));
    CHECK_THAT(r.err, Contains("have no sample") && Contains("keep.partial.exr") &&
                          Contains("is unchanged"));
    CHECK_THAT(r.out, Contains("unknown") && !Contains("95 % confidence"));
    REQUIRE(std::filesystem::exists(directory / "keep.partial.exr"));
    const ProcessResult info = RunLanelight({"info", directory / "keep.partial.exr"});
    CHECK_THAT(info.out, Contains("emptyPixels"));
    std::filesystem::remove(directory / "keep.partial.exr");
    std::filesystem::remove(directory / "keep.partial.png");
  }
}

TEST_CASE("an interrupted trial run leaves no image", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSlowScene(directory), exr = directory / "keep.exr";
  const std::string json = directory / "r.json";
  const ProcessResult r =
      InterruptAt("trial run", SIGINT,
                  {"render", scene, "-o", exr, "--json", json, "--spp", "64",
                   "--resolution", kSlowResolution, "--strategy", "decide=pilot"});
  INFO(r.err);
  CHECK(r.exit_code == kExitInterrupted);
  CHECK_THAT(r.err, Contains("stopped before its first sample"));
  CHECK_FALSE(std::filesystem::exists(exr));
  CHECK_FALSE(std::filesystem::exists(json));
  const nlohmann::json report = test::ReadJson(directory / "r.partial.json");
  CHECK(report.at("partial") == true);
  CHECK(report.at("unsampled_pixels") == kSlowWidth * kSlowHeight);
  CHECK(report.at("error").is_null());
}

TEST_CASE("an interruption after the first pass leaves an image without holes", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), exr = directory / "whole.exr";
  const ProcessResult r = InterruptAt(
      "rendering", SIGINT,
      {"render", scene, "-o", exr, "--spp", "100000", "--strategy", "decide=none"});
  INFO(r.err);
  CHECK(r.exit_code == kExitGood);
  CHECK_THAT(r.err, Contains("finishing the samples in flight"));
  CHECK_THAT(r.out, Contains("stopped early"));
  const Image image = ReadExr(exr);
  const int samples = image.FindChannel("samples");
  REQUIRE(samples >= 0);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) CHECK(image.At(x, y, samples) > 0);
  }
}

TEST_CASE("an interrupted render keeps the image of another render", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), exr = directory / "x.exr";
  const std::string json = directory / "x.json", partial = directory / "x.partial.exr";
  std::vector<std::string> render = {"render",      scene,    "-o", exr,
                                     "--png",       "--json", json, "--strategy",
                                     "decide=none", "--spp"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), render.begin(), render.end());
    return more;
  };
  REQUIRE(RunLanelight(with({"16", "--seed", "7"})).exit_code == kExitGood);
  std::map<std::string, std::string> before;
  for (const char* name : {"x.exr", "x.png", "x.json"}) {
    before[name] = BytesOf(directory / name);
  }
  const ProcessResult r = InterruptAt("rendering", SIGTERM, with({"1000000"}));
  INFO(r.out << r.err);
  CHECK(r.exit_code == kExitInterrupted);
  for (const auto& [name, bytes] : before) CHECK(BytesOf(directory / name) == bytes);
  CHECK_THAT(r.err, Contains("x.partial.exr") && Contains("x.exr' is unchanged"));
  CHECK_THAT(r.out, Contains("x.partial.exr") && Contains("x.partial.png"));
  CHECK(ReadExr(partial).width == 32);
  const nlohmann::json report = test::ReadJson(directory / "x.partial.json");
  CHECK(report.at("partial") == true);
  CHECK(report.at("unsampled_pixels") == 0);
  CHECK(report.at("output").at("exr") == partial);
  // A render of the same seed with fewer samples is part of the new image.
  REQUIRE(RunLanelight(with({"1"})).exit_code == kExitGood);
  const ProcessResult same = InterruptAt("rendering", SIGINT, with({"1000000"}));
  INFO(same.err);
  CHECK(same.exit_code == kExitGood);
  CHECK(std::get<double>(ReadExr(exr).attributes.at("spp")) > 1);
}

TEST_CASE("an interrupted sweep or study leaves no image with holes", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSlowScene(directory), out = directory / "out";
  const std::string sweep = WriteText(directory / "sweep.toml",
                                      fmt::format("[grid]\nscene = 'room.pbrt'\nspp = 1\n"
                                                  "strategy = '{}'\nresolution = '{}'\n",
                                                  kLongPaths, kSlowResolution));
  const std::vector<std::pair<std::string, std::vector<std::string>>> commands = {
      {"1 of 1", {"sweep", sweep, "--out", out + "/sweep"}},
      {"study",
       {"study", scene, "--out", out + "/study", "--resolution", kSlowResolution, "--spp",
        "1", "--strategies", "roulette=none;roulette=none,points=independent"}}};
  std::filesystem::create_directory(out);
  for (const auto& [trigger, arguments] : commands) {
    const ProcessResult r = InterruptAt(trigger, SIGINT, arguments);
    INFO(arguments[0] << ": " << r.err);
    CHECK(r.exit_code == kExitInterrupted);
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out)) {
    INFO(entry.path());
    CHECK(entry.path().extension() != ".exr");
  }
}

TEST_CASE("images of a sweep that do not fit on the disk are saved elsewhere", "[cli]") {
  TempDirectory directory, elsewhere;
  const std::string scene = WriteSphereScene(directory), out = directory / "out";
  const std::string sweep = WriteText(directory / "sweep.toml",
                                      "[grid]\nscene = 'sphere.pbrt'\nspp = [1, 2]\n");
  REQUIRE(RunLanelight({"sweep", sweep, "--out", out}).exit_code == kExitGood);
  std::map<std::string, std::string> before;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out)) {
    if (entry.path().extension() == ".exr") before[entry.path()] = BytesOf(entry.path());
    if (entry.path().filename() == "report.json") std::filesystem::remove(entry.path());
  }
  REQUIRE(before.size() == 2);
  ProcessOptions full;
  full.file_size_limit = 256;  // less than any image has
  full.temp_directory = elsewhere.path();
  const ProcessResult r = RunLanelight({"sweep", sweep, "--out", out}, full);
  INFO(r.err);
  CHECK(r.exit_code == kExitBadInput);
  for (const auto& [path, bytes] : before) CHECK(BytesOf(path) == bytes);
}

}  // namespace lanelight
