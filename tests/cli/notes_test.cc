// What compiling leaves out is said: on standard error, in the report, in a study.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

// On line 9 an area light of two triangles without area, on line 11 a mesh of which one
// of two is left.
std::string BrokenMeshes(const TempDirectory& directory) {
  return WriteText(directory / "broken.pbrt", R"(Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
Sampler "independent" "integer pixelsamples" 4
WorldBegin
LightSource "point" "point3 from" [ 0 3 0 ]
Material "diffuse"
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 5 5 5 ]
  Shape "trianglemesh" "point3 P" [ 0 0 5  1 0 5  2 0 5 ] "integer indices" [ 0 1 2 1 1 2 ]
AttributeEnd
Shape "trianglemesh" "point3 P" [ -1 -1 5  1 -1 5  0 1 5 ] "integer indices" [ 0 1 2 0 0 1 ]
)");
}

constexpr const char* kDead =
    "left out 2 degenerate triangles of 2; this area light has no area left and emits "
    "nothing";
constexpr const char* kDropped = "left out 1 degenerate triangles of 2";

}  // namespace

TEST_CASE("dropped triangles and dead lights are reported on standard error", "[cli]") {
  TempDirectory directory;
  const std::string scene = BrokenMeshes(directory), json = directory / "r.json";
  const ProcessResult r =
      RunLanelight({"render", scene, "-o", directory / "r.exr", "--json", json});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.err, Contains(scene + ":9:") && Contains(std::string("note: ") + kDead));
  CHECK_THAT(r.err, Contains(scene + ":11:") && Contains(kDropped));

  std::ifstream in(json);
  const nlohmann::json notes = nlohmann::json::parse(in).at("notes");
  REQUIRE(notes.size() == 2);
  CHECK(notes[0].at("message") == kDead);
  CHECK(notes[1].at("message") == kDropped);
  CHECK(notes[1].at("changes_image") == false);
  CHECK_THAT(notes[1].at("where").get<std::string>(), Contains(":11:"));

  const ProcessResult quiet =
      RunLanelight({"render", scene, "-o", directory / "r.exr", "--quiet"});
  CHECK(quiet.err.empty());
}

// A scene whose file asks for what is left out.
std::string MotionScene(const TempDirectory& directory) {
  return WriteText(directory / "moves.pbrt", R"(Camera "perspective"
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
Sampler "independent" "integer pixelsamples" 2
WorldBegin
LightSource "point" "point3 from" [ 0 3 0 ]
AreaLightSource "diffuse"
ActiveTransform EndTime
Translate 0 0 1
ActiveTransform All
Shape "sphere"
)");
}

constexpr const char* kDiffers =
    "the image differs from the scene file: skipped: "
    "an area light cannot move";

TEST_CASE("an image that deviates from the scene file has its own exit code", "[cli]") {
  TempDirectory directory;
  const std::string scene = MotionScene(directory), json = directory / "r.json";
  const ProcessResult r = RunLanelight(
      {"render", scene, "-o", directory / "r.exr", "--json", json, "--skip-unsupported"});
  INFO(r.out << r.err);
  CHECK(r.exit_code == kExitImageDiffers);
  const std::string last = r.out.substr(r.out.rfind('\n', r.out.size() - 2) + 1);
  CHECK_THAT(last, Contains("differs") && Contains(kDiffers));
  std::ifstream in(json);
  const nlohmann::json report = nlohmann::json::parse(in);
  CHECK(report.at("differs") == true);
  CHECK(report.at("notes").at(0).at("changes_image") == true);

  const ProcessResult quiet = RunLanelight(
      {"render", scene, "-o", directory / "r.exr", "--quiet", "--skip-unsupported"});
  CHECK(quiet.exit_code == kExitImageDiffers);
  CHECK_THAT(quiet.err, Contains(kDiffers));
  const ProcessResult plan = RunLanelight({"plan", scene, "--skip-unsupported"});
  CHECK(plan.exit_code == kExitGood);
  CHECK_THAT(plan.out, Contains(kDiffers));
}

TEST_CASE("a study and a sweep report deviations from the scene file", "[cli]") {
  TempDirectory directory;
  const std::string scene = MotionScene(directory), out = directory / "study";
  const ProcessResult study =
      RunLanelight({"study", scene, "--out", out, "--strategies", "default;points=halton",
                    "--spp", "1", "--repetitions", "2", "--skip-unsupported"});
  INFO(study.out << study.err);
  CHECK(study.exit_code == kExitGood);
  CHECK_THAT(study.out, Contains("differs from the scene file"));
  const std::string file = WriteText(directory / "sweep.toml",
                                     "[grid]\nscene = [\"moves.pbrt\"]\nspp = [1, "
                                     "2]\n[settings]\nskip-unsupported = true\n");
  const ProcessResult sweep = RunLanelight({"sweep", file, "--out", directory / "sweep"});
  INFO(sweep.out << sweep.err);
  CHECK(sweep.exit_code == kExitGood);
  CHECK_THAT(sweep.err, Contains("the images of 2 cells differ from"));
}

TEST_CASE("warnings are labelled and precede notes", "[cli]") {
  TempDirectory directory;
  std::ofstream(directory / "w.pbrt")
      << std::ifstream(BrokenMeshes(directory)).rdbuf() << "AttributeEnd\n";
  const std::string scene = directory / "w.pbrt", json = directory / "w.json";
  const ProcessResult r =
      RunLanelight({"render", scene, "-o", directory / "w.exr", "--json", json});
  INFO(r.err);
  CHECK(r.exit_code == kExitGood);
  CHECK(r.err.starts_with(scene + ":12:1: warning: AttributeEnd without"));
  std::ifstream in(json);
  const nlohmann::json notes = nlohmann::json::parse(in).at("notes");
  REQUIRE(notes.size() == 3);
  CHECK(notes[0].at("warning") == true);
  CHECK(notes[1].at("warning") == false);
}

TEST_CASE("a study keeps the notes of compiling", "[cli]") {
  TempDirectory directory;
  const std::string out = directory / "study";
  const ProcessResult r =
      RunLanelight({"study", BrokenMeshes(directory), "--out", out, "--strategies",
                    "default;points=halton", "--spp", "1", "--repetitions", "2"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  std::ifstream in(out + "/study.json");
  CHECK_THAT(nlohmann::json::parse(in).dump(), Contains(kDead) && Contains(kDropped));
}

TEST_CASE("a scene without light gets one warning, with any number of samples", "[cli]") {
  const TempDirectory directory;
  const std::string scene = WriteText(
      directory / "dark.pbrt",
      "Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 8 \"integer "
      "yresolution\" 8\nWorldBegin\nTranslate 0 0 4\nShape \"sphere\"\n");
  for (const char* spp : {"1", "2", "64"}) {
    const ProcessResult r =
        RunLanelight({"render", scene, "-o", directory / "dark.exr", "--spp", spp});
    INFO(r.out << r.err);
    CHECK(r.exit_code == kExitGood);
    const std::string warning =
        "no light reached the image; does the scene have a light?";
    const std::size_t at = r.err.find("warning: " + warning);
    REQUIRE(at != std::string::npos);
    CHECK(r.err.find(warning, at + 10) == std::string::npos);
    CHECK_THAT(r.out, !Contains(warning) && !Contains("at least 0 %"));
  }
  const ProcessResult lit = RunLanelight(
      {"render", WriteSphereScene(directory), "-o", directory / "lit.exr", "--spp", "1"});
  CHECK_THAT(lit.err, !Contains("no light"));
}

}  // namespace lanelight
