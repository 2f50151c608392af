// Scenes whose radiance leaves the range of single precision: the image is written, with
// zeros for the samples that are no numbers, and the exit code says so.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

constexpr int kWidth = 16, kHeight = 12, kSamples = 4;

// A sphere under skies of the largest radiance that a file can say.
std::string BrightScene(const TempDirectory& directory, int skies) {
  std::string text = R"(
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
PixelFilter "box"
Integrator "path" "integer maxdepth" 3
WorldBegin
Material "diffuse" "rgb reflectance" [0.5 0.4 0.3]
Shape "sphere" "float radius" 1
)";
  for (int i = 0; i < skies; ++i) {
    text += "LightSource \"infinite\" \"rgb L\" [3e38 3e38 3e38]\n";
  }
  return WriteText(directory / "bright.pbrt", text);
}

struct Outcome {
  ProcessResult process;
  nlohmann::json health;
  int zeros = 0, invalid = 0;  // pixels
};

Outcome RenderBright(int skies, const std::string& strategy,
                     const char* transport = "rgb") {
  TempDirectory directory;
  const std::string scene = BrightScene(directory, skies);
  const std::string exr = directory / "out.exr", json = directory / "out.json";
  Outcome out;
  out.process = RunLanelight({"render", scene, "-o", exr, "--spp",
                              std::to_string(kSamples), "--strategy", strategy,
                              "--transport", transport, "--json", json, "--quiet"});
  std::ifstream in(json);
  out.health = nlohmann::json::parse(in).at("health");
  const Image image = ReadExr(exr);
  REQUIRE(image.width == kWidth);
  REQUIRE(image.height == kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const int x = i % kWidth, y = i / kWidth;
    bool zero = true, finite = true;
    for (const char* name : {"R", "G", "B"}) {
      const float v = image.At(x, y, image.FindChannel(name));
      zero &= v == 0, finite &= std::isfinite(v);
    }
    out.zeros += zero, out.invalid += !finite;
  }
  return out;
}

}  // namespace

TEST_CASE("infinite samples: exit code 3, zeros in the image", "[cli]") {
  // Either sky alone can be written down; what a ray sees of both is infinite.
  const Outcome two = RenderBright(2, "points=sobol");
  CHECK(two.process.exit_code == kExitInvalidSamples);
  CHECK(two.health.at("nan") == 0);
  CHECK(two.health.at("negative") == 0);
  const int infinite = two.health.at("infinite");
  CHECK_THAT(two.process.err, Contains("error: " + std::to_string(infinite) +
                                       " samples were invalid and count as zero"));
  CHECK(infinite > kWidth * kHeight * kSamples / 2);
  CHECK(two.zeros > kWidth * kHeight / 2);
  CHECK(two.invalid == 0);
}

TEST_CASE("NaN samples: exit code 3, zeros in the image", "[cli]") {
  // Infinite radiance at three wavelengths: a colour takes differences of these.
  const Outcome out = RenderBright(2, "points=sobol", "spectral");
  CHECK(out.process.exit_code == kExitInvalidSamples);
  CHECK(out.health.at("nan") > kSamples);
  CHECK(out.health.at("negative") == 0);
  CHECK_THAT(out.process.err, Contains("samples were invalid and count as zero"));
  CHECK(out.zeros > 0);
  CHECK(out.invalid == 0);
}

TEST_CASE("the brightest samples that are numbers are no error", "[cli]") {
  const Outcome one = RenderBright(1, "points=sobol");
  CHECK(one.process.exit_code == 0);
  CHECK(one.process.err.empty());
  CHECK(one.health == nlohmann::json{{"nan", 0}, {"infinite", 0}, {"negative", 0}});
  CHECK(one.zeros == 0);
  CHECK(one.invalid == 0);
}

}  // namespace lanelight
