// What a person sees: the last screen, tables that fit, values with units, notes.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src/base/core/text_layout.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

ProcessOptions InColumns(const char* columns) {
  ProcessOptions options;
  options.columns = columns;
  return options;
}

std::size_t WidestLine(const std::string& text) {
  std::istringstream in(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(in, line);) {
    widest = std::max(widest, TextWidth(line));
  }
  return widest;
}

nlohmann::json SettingsOf(const std::vector<std::string>& flags) {
  TempDirectory directory;
  const std::string json = directory / "r.json";
  std::vector<std::string> arguments = {
      "render", WriteSphereScene(directory), "-o", directory / "r.exr", "--json", json};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  const ProcessResult r = RunLanelight(arguments);
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  std::ifstream in(json);
  return nlohmann::json::parse(in).at("settings");
}

}  // namespace

TEST_CASE("the summary prints the main results, -v the details", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), exr = directory / "out.exr";
  const ProcessResult r = RunLanelight({"render", scene, "-o", exr, "--spp", "16"});
  REQUIRE(r.exit_code == kExitGood);
  for (const char* word : {"image", "32x24 pixels, 16 samples each", "error", " % [",
                           "95 % confidence", "time", "samples/s", "rays/s", "next",
                           "half the error takes about 4 times as long: --spp 64"}) {
    CHECK_THAT(r.out, Contains(word));
  }
  for (const char* word : {"stage", "machine", "kernels", "all valid"}) {
    CHECK_THAT(r.out, !Contains(word));
  }
  CHECK(std::count(r.out.begin(), r.out.end(), '\n') <= 8);
  const ProcessResult all =
      RunLanelight({"render", scene, "-o", exr, "--spp", "16", "-v"});
  for (const char* word : {"directions=mis:power", "stage", "machine", "kernels",
                           "all valid", "ns/item", "RMSE"}) {
    CHECK_THAT(all.out, Contains(word));
  }
  CHECK(RunLanelight({"render", scene, "-o", exr, "-v", "--quiet"}).exit_code ==
        kExitUsage);
}

TEST_CASE("output fits the terminal, without colours in a pipe", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), exr = directory / "out.exr";
  const std::vector<std::string> render = {"render", scene, "-o", "out.exr",
                                           "--spp",  "16",  "-v"};
  ProcessOptions narrow = InColumns("50");
  const std::string folder = directory.path();
  narrow.prepare = [folder] {
    if (chdir(folder.c_str()) != 0) _exit(126);
  };
  const ProcessResult r = RunLanelight(render, narrow);
  INFO(r.out);
  REQUIRE(r.exit_code == kExitGood);
  CHECK(WidestLine(r.out) <= 50);
  CHECK(r.out.find('\x1b') == std::string::npos);
  CHECK(r.err.find('\x1b') == std::string::npos);
  CHECK(r.err.find('\r') == std::string::npos);
  const std::vector<std::string> bench = {
      "bench", scene, "--spp", "1", "--time", "100ms", "--threads", "1", "--within", "1"};
  const ProcessResult default_width = RunLanelight(bench, InColumns(""));
  REQUIRE(default_width.exit_code == kExitGood);
  CHECK(WidestLine(default_width.out) <= 80);
  CHECK_THAT(default_width.out, Contains("bytes/path") && Contains("repeats"));
  const ProcessResult wide = RunLanelight(bench, InColumns("200"));
  CHECK(WidestLine(wide.out) > 80);
}

TEST_CASE("facts of images fit a terminal, and are lines of their own in a pipe",
          "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const std::string a = directory / "a.exr", b = directory / "b.exr";
  for (const std::string& exr : {a, b}) {
    REQUIRE(RunLanelight({"render", scene, "-o", exr}).exit_code == kExitGood);
  }
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"info", a}, {"compare", a, b, "--flip"}}) {
    ProcessOptions narrow = InColumns("70");
    const std::string folder = directory.path();
    narrow.prepare = [folder] {
      if (chdir(folder.c_str()) != 0) _exit(126);
    };
    std::vector<std::string> here = command;
    for (std::string& word : here) {
      if (word == a || word == b) word = word.substr(folder.size() + 1);
    }
    const ProcessResult fitted = RunLanelight(here, narrow);
    INFO(fitted.out);
    REQUIRE(fitted.exit_code == kExitGood);
    CHECK(WidestLine(fitted.out) <= 70);
    CHECK(WidestLine(RunLanelight(command, InColumns("")).out) > 100);
  }
}

TEST_CASE("lists fit a terminal, and are lines of their own in a pipe", "[cli]") {
  TempDirectory directory;
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"plan", WriteSphereScene(directory), "-v"}, {"strategies"}}) {
    const ProcessResult fitted = RunLanelight(command, InColumns("70"));
    INFO(fitted.out);
    REQUIRE(fitted.exit_code == kExitGood);
    // The first line of a plan is the name of its scene.
    CHECK(WidestLine(fitted.out.substr(fitted.out.find('\n'))) <= 70);
    CHECK(WidestLine(RunLanelight(command, InColumns("")).out) > 100);
  }
}

TEST_CASE("amounts have units", "[cli]") {
  const nlohmann::json s = SettingsOf({"--spp", "1k", "--time", "5m", "--target", "20%"});
  CHECK(s.at("spp") == 1000);
  CHECK(s.at("time_budget") == 300);
  CHECK(s.at("target_relmse").get<double>() == Approx(0.04));
  struct Wrong {
    std::vector<std::string> flags;
    const char* message;
  };
  for (const Wrong& w : std::vector<Wrong>{
           {{"--spp", "10q"}, "--spp: \"10q\" is not an integer from 1 to"},
           {{"--time", "5 minutes"}, "e.g. 90, 5m, 1h30m or 500ms"},
           {{"--target", "1"}, "--target: 1 is not an error in percent"},
           {{"--target", "AVX2"}, "--simd"},
           {{"--target", "1%", "--target-relmse", "0.1"}, "excludes"},
           {{"--display-server", "here:there"}, "HOST:PORT, e.g. localhost:14158"},
           {{"--watch", "x.jpg"}, ".exr or .png"}}) {
    std::vector<std::string> arguments = {"render", "x.pbrt", "-o", "x.exr"};
    arguments.insert(arguments.end(), w.flags.begin(), w.flags.end());
    const ProcessResult r = RunLanelight(arguments);
    INFO(r.err);
    CHECK(r.exit_code == kExitUsage);
    CHECK_THAT(r.err, Contains(w.message));
  }
}

TEST_CASE("notes of the same kind are printed in one line", "[cli]") {
  TempDirectory directory;
  std::string text = R"(Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "point" "point3 from" [ 0 3 0 ]
)";
  for (int i = 0; i < 20; ++i) {
    text +=
        "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 5  1 -1 5  0 1 5 ] \"integer "
        "indices\" [ 0 1 2 0 0 1 ]\n";
  }
  const ProcessResult r = RunLanelight({"render", WriteText(directory / "s.pbrt", text),
                                        "-o", directory / "s.exr", "--spp", "1"});
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.err, Contains("s.pbrt:5:") && Contains("(and 19 more like it)"));
  CHECK(r.err.find("left out", r.err.find("left out") + 1) == std::string::npos);
}

TEST_CASE("a checkpoint of another strategy is refused with the differences", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), state = directory / "s.state";
  REQUIRE(RunLanelight({"render", scene, "-o", directory / "a.exr", "--checkpoint", state,
                        "--strategy", "roulette=none"})
              .exit_code == kExitGood);
  const ProcessResult r =
      RunLanelight({"render", scene, "-o", directory / "a.exr", "--checkpoint", state,
                    "--resume", "--strategy", "points=halton"});
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err,
             Contains("strategy: the state has points=independent,roulette=none, this "
                      "render points=halton,roulette=throughput"));
  CHECK(r.err.find("directions=") == std::string::npos);
}

TEST_CASE("the printed strategy is the one that renders", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), exr = directory / "a.exr";
  const ProcessResult explicit_run =
      RunLanelight({"render", scene, "-o", exr, "--strategy", "roulette=none"});
  // The scene itself asks for independent points.
  CHECK_THAT(explicit_run.out, Contains("strategy   points=independent,roulette=none\n"));
  CHECK_THAT(RunLanelight({"render", scene, "-o", exr, "--sampler", "sobol"}).out,
             !Contains("strategy"));
  // A pilot decides in long renders, and so says the plan.
  CHECK_THAT(RunLanelight({"plan", scene, "--time", "1h"}).out,
             Contains("decide=pilot") && Contains("trial run before"));
  CHECK_THAT(RunLanelight({"plan", scene, "--spp", "1"}).out, Contains("decide=none"));
}

TEST_CASE("the image so far is written as EXR and as PNG", "[cli]") {
  TempDirectory directory;
  const std::string png = directory / "so-far.png", exr = directory / "so-far.exr";
  const ProcessResult r = RunLanelight({"render", WriteSphereScene(directory), "-o",
                                        directory / "a.exr", "--time", "500ms", "--every",
                                        "100ms", "--watch", png, "--watch", exr});
  INFO(r.err);
  CHECK(r.exit_code == kExitGood);
  std::ifstream in(png, std::ios::binary);
  std::string head(4, '\0');
  in.read(head.data(), 4);
  CHECK(head == "\x89PNG");
  CHECK(std::filesystem::exists(exr));
}

}  // namespace lanelight
