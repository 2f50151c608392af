// Files that an image of a render that ended early may replace.
#include "src/render/job/partial_outputs.h"

#include <catch2/catch.hpp>

#include "tests/cli/process.h"

namespace lanelight {
namespace {

ExrOptions ImageOf(const std::string& seed, double spp) {
  ExrOptions options;
  for (const char* name : {"sceneHash", "settings", "strategy", "version"}) {
    options.attributes[name] = std::string("same");
  }
  options.attributes["seed"] = seed;
  options.attributes["spp"] = spp;
  return options;
}

void Write(const std::string& path, const ExrOptions& options) {
  WriteExr(path, 1, 1, {{"R", {1}}, {"G", {1}}, {"B", {1}}}, options);
}

}  // namespace

TEST_CASE("an early image replaces the same render with fewer samples only", "[render]") {
  TempDirectory directory;
  RenderTargets targets;
  targets.exr = directory / "x.exr";
  const ExrOptions image = ImageOf("1", 12.7);
  const auto free = [&](int first) { return FreePartialNumber(targets, image, first); };
  CHECK(free(0) == 0);
  CHECK(free(1) == 1);
  for (const double fewer : {1.0, 12.7}) {
    Write(targets.exr, ImageOf("1", fewer));
    CHECK(free(0) == 0);
  }
  Write(targets.exr, ImageOf("1", 256));
  CHECK(free(0) == 1);
  Write(targets.exr, ImageOf("2", 1));
  CHECK(free(0) == 1);
  Write(targets.exr, {});  // by another program
  CHECK(free(0) == 1);
  WriteText(targets.exr, "not an image");
  CHECK(free(0) == 1);
  Write(directory / "x.partial.exr", ImageOf("1", 4));
  CHECK(free(0) == 1);
  Write(directory / "x.partial.exr", ImageOf("1", 13));
  CHECK(free(0) == 2);
  Write(directory / "x.partial-2.exr", ImageOf("3", 4));
  CHECK(free(1) == 3);
}

TEST_CASE("a PNG or a report without its image is not replaced", "[render]") {
  TempDirectory directory;
  RenderTargets targets;
  targets.exr = directory / "x.exr";
  targets.png = WriteText(directory / "x.png", "some image");
  targets.json = "-";
  const ExrOptions image = ImageOf("1", 4);
  CHECK(FreePartialNumber(targets, image, 0) == 1);
  targets.png = "";
  CHECK(FreePartialNumber(targets, image, 0) == 0);
  targets.json = WriteText(directory / "x.json", "{}");
  CHECK(FreePartialNumber(targets, image, 0) == 1);
  // PNG and report of an image that is replaced are replaced with it.
  Write(targets.exr, ImageOf("1", 2));
  CHECK(FreePartialNumber(targets, image, 0) == 0);
}

TEST_CASE("partial files of one render have the same number", "[render]") {
  RenderTargets targets;
  targets.exr = "a/x.exr";
  targets.png = "b.y.png";
  targets.json = "-";
  const RenderTargets second = PartialTargets(targets, 2);
  CHECK(second.exr == "a/x.partial-2.exr");
  CHECK(second.png == "b.y.partial-2.png");
  CHECK(second.json == "-");
  CHECK(PartialTargets(targets, 1).exr == "a/x.partial.exr");
  CHECK(PartialTargets(targets, 0).exr == targets.exr);
}

}  // namespace lanelight
