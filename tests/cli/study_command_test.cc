// `lanelight study` from the outside: flags, files, interruptions.
#include <catch2/catch.hpp>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <thread>

#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"
#include "tests/measure/study/study_file.h"

namespace lanelight {
namespace {

using Catch::Contains;
using Json = nlohmann::json;

std::vector<std::string> StudyOf(const std::string& scene, const std::string& out) {
  return {"study",         scene,
          "--out",         out,
          "--strategies",  "paper-plain; default ;;points=halton",
          "--spp",         "1,4,16",
          "--repetitions", "4",
          "--resolution",  "48x36",
          "--threads",     "2"};
}

std::vector<std::string> With(std::vector<std::string> arguments,
                              const std::string& more) {
  arguments.push_back(more);
  return arguments;
}

}  // namespace

TEST_CASE("study: a killed study resumes", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const ProcessResult r = RunLanelight(StudyOf(scene, directory / "whole"));
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("efficiency") && Contains("paper-plain") &&
                        Contains("report.html") &&
                        Contains("the most efficient strategy"));
  CHECK_THAT(r.err, Contains("100 %"));
  Json whole = ReadJson(directory / "whole/study.json");
  RemoveTimings(whole);

  int killed = 0;
  for (double part : {0.15, 0.4, 0.6, 0.8, 0.95}) {
    const std::string out = directory / ("part" + std::to_string(killed++));
    std::vector<std::string> arguments = With(StudyOf(scene, out), "--resume");
    ProcessOptions options;
    options.trigger = "study";
    options.action = [&](int child) {
      std::this_thread::sleep_for(std::chrono::duration<double>(part * r.seconds));
      kill(child, SIGKILL);
    };
    RunLanelight(arguments, options);
    const ProcessResult resumed = RunLanelight(arguments);
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == kExitGood);
    Json json = ReadJson(out + "/study.json");
    RemoveTimings(json);
    INFO(Json::diff(whole, json).dump(1));
    CHECK((json == whole));
  }
}

TEST_CASE("study: two processes share one study", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  REQUIRE(RunLanelight(StudyOf(scene, directory / "whole")).exit_code == kExitGood);
  Json whole = ReadJson(directory / "whole/study.json");
  RemoveTimings(whole);
  const std::vector<std::string> arguments =
      With(StudyOf(scene, directory / "out"), "--resume");
  const auto run = [&] { return RunLanelight(arguments); };
  auto other = std::async(std::launch::async, run);
  for (const ProcessResult& r : {run(), other.get()}) {
    INFO(r.err);
    CHECK(r.exit_code == kExitGood);
  }
  Json json = ReadJson(directory / "out/study.json");
  RemoveTimings(json);
  INFO(Json::diff(whole, json).dump(1));
  CHECK((json == whole));
}

TEST_CASE("study: Ctrl-C reports what is finished", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  std::vector<std::string> arguments = StudyOf(scene, directory / "out");
  arguments[9] = "200";  // repetitions: far from finished
  ProcessOptions options;
  options.trigger = "repetition 3";
  options.action = [](int child) { kill(child, SIGINT); };
  const ProcessResult r = RunLanelight(arguments, options);
  INFO(r.err);
  CHECK(r.exit_code == kExitInterrupted);
  CHECK_THAT(r.err, Contains("--resume continues"));
  CHECK_THAT(r.out, Contains("interrupted"));
  const Json json = ReadJson(directory / "out/study.json");
  CHECK(json["scenes"][0]["interrupted"] == true);
  CHECK(json["scenes"][0]["ranking"].size() == 3);
}

TEST_CASE("study: invalid input is reported with a remedy", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const std::string out = directory / "out";
  const auto fails = [&](std::vector<std::string> flags, int code, const char* text) {
    std::vector<std::string> arguments = {"study", scene};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const ProcessResult r = RunLanelight(arguments);
    INFO(r.err);
    CHECK(r.exit_code == code);
    CHECK_THAT(r.err, Contains(text));
    CHECK_FALSE(std::filesystem::exists(out + "/study.json"));
  };
  fails({}, kExitUsage, "--out");
  fails({"--out", out, "--strategies", "points=sobol;color=red"}, kExitUsage,
        "unknown key \"color\"");
  fails({"--out", out, "--spp", "1,0"}, kExitUsage, "--spp");
  fails({"--out", out, "--spp", "4", "--budget", "1"}, kExitUsage, "--budget");
  fails({"--out", out, "--all", "--strategies", "default"}, kExitUsage, "--strategies");
  fails({"--out", out, "--confidence", "95"}, kExitUsage, "0.5");
  fails({"--out", out, "--target-relmse", "nan"}, kExitUsage, "--target-relmse");
  fails({"--out", out, "--reference", directory / "none.exr"}, kExitBadInput, "none.exr");
  fails({"--out", scene}, kExitBadInput, "not a directory");
  fails({"--out", "/proc/nowhere"}, kExitBadInput, "/proc/nowhere");
  fails({"--out", directory.path()}, kExitBadInput, "not empty");
  const ProcessResult missing =
      RunLanelight({"study", directory / "no.pbrt", "--out", out});
  CHECK(missing.exit_code == kExitBadInput);
  CHECK_THAT(missing.err, Contains("no.pbrt") && !Contains("error: error:"));
}

TEST_CASE("study: a full disk keeps finished renders", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  std::vector<std::string> arguments =
      With(StudyOf(scene, directory / "out"), "--resume");
  ProcessOptions options;
  options.file_size_limit = 60000;  // the report does not fit
  const ProcessResult full = RunLanelight(arguments, options);
  CHECK(full.exit_code == kExitBadInput);
  CHECK_THAT(full.err, Contains("cannot write"));
  const ProcessResult again = RunLanelight(arguments);
  INFO(again.err);
  CHECK(again.exit_code == kExitGood);
  CHECK(std::filesystem::exists(directory / "out/report.html"));
}

}  // namespace lanelight
