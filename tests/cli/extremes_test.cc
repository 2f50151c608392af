// Scenes of absurd sizes end, in an image or in an error.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight::extremes {
namespace {

// Renders into o.exr, or the `image` named.
ProcessResult Render(const TempDirectory& directory, const std::string& world,
                     const std::string& strategy = "decide=none",
                     const std::string& image = "o.exr") {
  const std::string scene = WriteText(
      directory / "scene.pbrt",
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\n"
      "MakeNamedMedium \"grid\" \"string type\" \"uniformgrid\" \"integer nx\" 2 "
      "\"float density\" [0 1e20]\n"
      "Camera \"perspective\"\nWorldBegin\n" +
          world);
  return RunLanelight({"render", scene, "-o", directory / image, "--spp", "4",
                       "--resolution", "8x6", "--strategy", strategy});
}

// What adds nothing to an image changes nothing in it: o.exr is that of the scene
// without.
void CheckSameAs(const TempDirectory& directory, const std::string& world,
                 const std::string& strategy) {
  REQUIRE(Render(directory, world, strategy, "without.exr").exit_code == kExitGood);
  const ProcessResult r =
      RunLanelight({"compare", directory / "o.exr", directory / "without.exr",
                    "--max-relmse", "1e-9"});
  INFO(r.out << r.err);
  CHECK(r.exit_code == kExitGood);
}

const std::string kSphere = "Shape \"sphere\"\n", kDisk = "Shape \"disk\"\n";
constexpr const char* kFarTriangle =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
    "\"point3 P\" [0 0 0 1 0 0 0 3.5e38 1]\n";
constexpr const char* kLamp = "LightSource \"point\" \"point3 from\" [1 2 3]\n";

}  // namespace

TEST_CASE("lights of no size beside their distance", "[cli][extremes]") {
  const TempDirectory directory;
  for (const char* strategy :
       {"light-selection=power", "light-selection=tree", "light-points=solid-angle"}) {
    for (const std::string& shape : {kSphere, kDisk}) {
      const std::string near =
          std::string("AreaLightSource \"diffuse\"\nAttributeBegin\nTranslate 0 0 3\n") +
          shape + "AttributeEnd\n";
      const ProcessResult r =
          Render(directory, near + "Translate 1.2 3.5e38 -1\n" + shape, strategy);
      INFO(strategy << ": " << r.err);
      CHECK(r.exit_code == kExitGood);
      // Beside it a sphere of radius 1 is left out, which is said.
      if (shape == kSphere) {
        CHECK_THAT(r.err, Catch::Contains("scene.pbrt:8:7: note: left out this sphere"));
      } else {
        CheckSameAs(directory, near, strategy);
      }
    }
  }
}

TEST_CASE("media of no size beside the scene", "[cli][extremes]") {
  const TempDirectory directory;
  for (const char* size : {"1e-25", "1e-9", "1e-6", "1"}) {
    for (const char* medium : {"m", "grid"}) {
      const std::string interface =
          fmt::format(
              "AttributeBegin\nMaterial \"interface\"\n"
              "MediumInterface \"{}\" \"\"\nTranslate 0 0 5\nScale {} {} {}\n",
              medium, size, size, size) +
          "Shape \"sphere\"\nShape \"cylinder\"\nAttributeEnd\n";
      for (const char* rest : {kFarTriangle, "Shape \"sphere\"\n"}) {
        const ProcessResult r = Render(directory, kLamp + interface + rest);
        INFO(size << " " << medium << ": " << r.err);
        CHECK(r.exit_code == kExitGood);
        if (std::string(size) == "1") continue;  // which is seen
        CheckSameAs(directory, std::string(kLamp) + rest, "decide=none");
      }
    }
  }
}

TEST_CASE("media around nothing that rays can hit", "[cli][extremes]") {
  const TempDirectory directory;
  const std::string nothing =
      "Material \"interface\"\nMediumInterface \"m\" \"\"\n"
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 0 0 0 0 0 "
      "1]";
  const ProcessResult r =
      Render(directory, "MediumInterface \"\" \"m\"\n" + (kLamp + nothing));
  INFO(r.err);
  CHECK(r.exit_code == kExitGood);
}

}  // namespace lanelight::extremes
