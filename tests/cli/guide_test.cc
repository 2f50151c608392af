// `lanelight guide` from the outside.
#include <catch2/catch.hpp>
#include <filesystem>

#include "src/cli/exit_codes.h"
#include "src/image/image.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

const std::string kGuideBox =
    std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt";

ProcessResult DrawGuide(const std::string& scene, const std::string& pixel,
                        const std::string& output) {
  return RunLanelight({"guide", scene, "--pixel", pixel, "-o", output, "--resolution",
                       "32x32", "--samples", "2e5"});
}

}  // namespace

TEST_CASE("guide draws what it has learned and says where", "[cli]") {
  TempDirectory directory;
  const std::string picture = directory / "guide.png";
  const ProcessResult r = DrawGuide(kGuideBox, "16,28", picture);
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("point ") && Contains("guide of "));
  const Image image = ReadImage(picture);
  CHECK(image.width > 2 * image.height);
}

TEST_CASE("guide says what is wrong before it learns anything", "[cli]") {
  TempDirectory directory;
  const std::string picture = directory / "guide.png";
  CHECK(RunLanelight({"guide", kGuideBox, "-o", picture}).exit_code == kExitUsage);
  CHECK(DrawGuide(kGuideBox, "16", picture).exit_code == kExitUsage);
  const ProcessResult outside = DrawGuide(kGuideBox, "32,0", picture);
  CHECK(outside.exit_code == kExitBadInput);
  CHECK_THAT(outside.err, Contains("32,0 is not in the image of 32x32 pixels"));
  const ProcessResult nowhere = DrawGuide(kGuideBox, "1,1", "/nowhere/guide.png");
  CHECK(nowhere.exit_code == kExitBadInput);
  CHECK(DrawGuide(kGuideBox, "1,1", kGuideBox).exit_code == kExitBadInput);
  CHECK(!std::filesystem::exists(picture));
}

}  // namespace lanelight
