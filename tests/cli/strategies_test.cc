// --strategy and `lanelight strategies`, through the program.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "src/cli/exit_codes.h"
#include "src/vocabulary/strategy/strategy.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Matchers::Contains;

const char* const kHead =
    "Camera \"perspective\" \"float fov\" 40\n"
    "Film \"rgb\" \"integer xresolution\" 12 \"integer yresolution\" 12\n"
    "WorldBegin\nTranslate 0 0 4\n";
const char* const kBall =
    "Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.5 0.5 ]\n"
    "Shape \"sphere\" \"float radius\" 1\n";
const char* const kSky = "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n";

std::string WriteScene(const TempDirectory& directory, const std::string& lights) {
  const std::string path = directory / "scene.pbrt";
  WriteText(path, std::string(kHead) + lights + kBall);
  return path;
}

}  // namespace

TEST_CASE("lanelight strategies lists every choice and preset", "[cli]") {
  const ProcessResult text = RunLanelight({"strategies"});
  REQUIRE(text.exit_code == kExitGood);
  for (const ChoiceInfo& c : AllChoices()) {
    CHECK_THAT(text.out, Contains(std::string(c.axis) + "=\n"));
    CHECK_THAT(text.out, Contains(std::string("  ") + c.name + c.arguments + "\n"));
    CHECK_THAT(text.out, Contains(c.formula));
  }
  for (const PresetInfo& p : AllPresets()) CHECK_THAT(text.out, Contains(p.name));
  const ProcessResult json = RunLanelight({"strategies", "--json"});
  const nlohmann::json list = nlohmann::json::parse(json.out);
  CHECK(list.at("choices").size() == AllChoices().size());
  CHECK(list.at("presets").size() == AllPresets().size());
}

TEST_CASE("the default of decide is documented for each command", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteScene(directory, kSky);
  const auto plan = [&](const char* spp) {
    return RunLanelight({"plan", scene, "--spp", spp}).out;
  };
  CHECK_THAT(plan("1"), Contains("decide=none"));
  CHECK_THAT(plan("1000000"), Contains("decide=pilot"));
  const std::string list = RunLanelight({"strategies"}).out;
  const std::string decide = list.substr(list.find("decide=\n"));
  CHECK_THAT(decide,
             Contains("default for short renders, and if a strategy is named") &&
                 Contains("chooses another roulette, path reuse or light subpaths") &&
                 Contains("from 4 s or 8 million samples"));
}

TEST_CASE("--strategy is used, reported, and changes the plan", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteScene(directory, kSky);
  const ProcessResult r = RunLanelight(
      {"render", scene, "-o", directory / "r.exr", "--spp", "8", "--json", "-",
       "--strategy", "directions=bsdf,points=stratified,pairs=antithetic"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  const nlohmann::json report = nlohmann::json::parse(r.out);
  CHECK_THAT(report.at("settings").at("strategy").get<std::string>(),
             Contains("directions=bsdf,points=stratified,pairs=antithetic"));
  CHECK_THAT(report.at("plan").at("stages").dump(), Contains("antithetic_camera"));
  CHECK_THAT(report.at("plan").at("omitted_stages").dump(),
             Contains("no sampled lights"));
}

TEST_CASE("a strategy that the scene does not support is refused with a remedy",
          "[cli]") {
  TempDirectory directory;
  const std::string out = directory / "r.exr";
  const std::string sky = WriteScene(directory, kSky);
  const auto refusal = [&](const std::string& scene, const std::string& strategy) {
    const ProcessResult r =
        RunLanelight({"render", scene, "-o", out, "--strategy", strategy});
    CHECK(r.exit_code == kExitBadInput);
    return r.err;
  };
  CHECK_THAT(refusal(sky, "reuse=block,roulette=adjoint"),
             Contains("roulette=throughput"));
  CHECK_THAT(refusal(sky, "paper-control,reuse=block"),
             Contains("control=regression needs samples of single paths"));
  const std::string point = WriteScene(
      directory, "LightSource \"point\" \"rgb I\" [ 9 9 9 ] \"point3 from\" [ 0 3 0 ]\n");
  const ProcessResult note = RunLanelight(
      {"render", point, "-o", out, "--spp", "1", "--strategy", "light-selection=tree"});
  CHECK(note.exit_code == kExitGood);
  CHECK_THAT(note.err, Contains("light-selection=tree has no effect"));
}

}  // namespace lanelight
