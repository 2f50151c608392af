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

TEST_CASE("dropped triangles and dead lights are said on standard error", "[cli]") {
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
  CHECK_THAT(notes[1].at("where").get<std::string>(), Contains(":11:"));

  const ProcessResult quiet =
      RunLanelight({"render", scene, "-o", directory / "r.exr", "--quiet"});
  CHECK(quiet.err.empty());
}

TEST_CASE("a study keeps the notes of compiling", "[cli]") {
  TempDirectory directory;
  const std::string out = directory / "study";
  const ProcessResult r =
      RunLanelight({"study", BrokenMeshes(directory), "--out", out, "--strategies",
                    "default;points=cmj", "--spp", "1", "--repetitions", "2"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  std::ifstream in(out + "/study.json");
  CHECK_THAT(nlohmann::json::parse(in).dump(), Contains(kDead) && Contains(kDropped));
}

}  // namespace lanelight
