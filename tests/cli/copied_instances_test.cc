// `--copied-triangles` from the outside: the same image, with and without instances.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/image/exr.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

// A strip with normals of its own and a pattern, placed upright, mirrored and stretched.
const char kScene[] = R"(
LookAt 0 1 -5   0 0 0   0 1 0
Camera "perspective" "float fov" [ 50 ]
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
LightSource "distant" "rgb L" [ 2 1.8 1.5 ] "point3 from" [ 1 3 -2 ] "point3 to" [ 0 0 0 ]
Texture "squares" "spectrum" "checkerboard" "float uscale" [ 3 ] "float vscale" [ 2 ]
    "rgb tex1" [ 0.8 0.7 0.6 ] "rgb tex2" [ 0.1 0.2 0.1 ]
ObjectBegin "strip"
    Material "coateddiffuse" "texture reflectance" [ "squares" ] "float roughness" [ 0.3 ]
    Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
        "point3 P" [ -1 -1 0  1 -1 0.3  1 1 0  -1 1 0.3 ]
        "normal N" [ -0.4 0 -1  0.4 0.2 -1  0.3 0 -1  -0.2 0.1 -1 ]
        "point2 uv" [ 0 0 1 0 1 1 0 1 ]
ObjectEnd
ObjectInstance "strip"
AttributeBegin
    Translate -1.6 0.2 0.4 Rotate 40 0 1 0.2 Scale -1 1 1
    ObjectInstance "strip"
AttributeEnd
AttributeBegin
    Translate 1.7 0 0.2 Rotate -30 1 0.4 0 Scale 0.6 1.4 -0.8
    ObjectInstance "strip"
AttributeEnd
)";

std::vector<float> RenderWith(const std::string& scene, const std::string& max_copies) {
  const TempDirectory directory;
  const ProcessResult r =
      RunLanelight({"render", scene, "-o", directory / "a.exr", "--resolution", "40x30",
                    "--spp", "16", "--copied-triangles", max_copies, "--quiet"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  const Image image = ReadExr(directory / "a.exr");
  return {image.pixels.begin(), image.pixels.end()};
}

TEST_CASE("copied instances render the same image as instances", "[cli]") {
  const TempDirectory directory;
  const std::string scene = WriteText(directory / "strips.pbrt", kScene);
  const std::vector<float> kept = RenderWith(scene, "0"), copied = RenderWith(scene, "9");
  REQUIRE(kept.size() == copied.size());
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    difference += std::abs(kept[i] - copied[i]);
    sum += kept[i];
  }
  REQUIRE(sum > 0);
  // Other rounding moves few samples; another normal, place or pattern moves all.
  CHECK(difference < 1e-3 * sum);
  CHECK(kept != copied);  // it was traced another way
}

TEST_CASE("the number of triangles to copy has a range", "[cli]") {
  const ProcessResult r =
      RunLanelight({"plan", "scenes/instances.pbrt", "--copied-triangles", "-1"});
  CHECK(r.exit_code == kExitUsage);
  CHECK_THAT(r.err, Contains("--copied-triangles"));
}

}  // namespace
}  // namespace lanelight
