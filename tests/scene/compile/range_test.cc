// What float32 does not hold of a scene beside its size: refused where it stands, or left
// out with a note, and never compiled into infinities.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/error.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compile/focus.h"
#include "src/scene/compiled/media.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/geometry/geometry.h"
#include "src/scene/parse/parse.h"

namespace lanelight::far_range {
namespace {

using Catch::Contains;

// Under `before`, a sphere of radius 1 and `body`, which begins in line 5.
CompiledScene Compile(const std::string& body, const std::string& before = "") {
  return CompileScene(ParseSceneText(before + "\nWorldBegin\nShape \"sphere\"\n\n" + body,
                                     "far.pbrt", "."),
                      {});
}

std::string NotesOf(const CompiledScene& scene) {
  std::string text;
  for (const Note& note : scene.notes) {
    text += note.where.ToString() + ": " + note.message + "\n";
  }
  return text;
}

constexpr const char* kFar = "Translate 1.2 3.5e38 -1\n";

}  // namespace

TEST_CASE("a light position beyond float32 is refused with its location", "[compile]") {
  for (const char* light : {"\"point\"", "\"spot\"", "\"point\" \"float power\" 10"}) {
    INFO(light);
    const std::string text = std::string("LightSource ") + light + "\n";
    CHECK_THROWS_WITH(Compile(kFar + text), Contains("far.pbrt:6:") &&
                                                Contains("this light") &&
                                                Contains("distant"));
    CHECK_THROWS_AS(Compile("Scale 1e300 1e300 1e300\nTranslate 1 0 0\n" + text),
                    InputError);
    // As far as its square is a number.
    const CompiledScene scene = Compile("Translate 0 1e18 0\n" + text);
    REQUIRE(scene.lights.lights.size() == 1);
    CHECK(std::isfinite(scene.lights.lights[0].position[1]));
  }
  CHECK_THROWS_WITH(Compile("LightSource \"infinite\" \"point3 portal\" "
                            "[-1 -1 1e30  1 -1 1e30  1 1 1e30  -1 1 1e30]"),
                    Contains("far.pbrt:5:") && Contains("this portal"));
}

TEST_CASE("a light that emits more than float32 holds is refused", "[compile]") {
  for (const char* light :
       {"LightSource \"point\" \"float scale\" 1e30 \"rgb I\" [1e30 1 1]",
        "LightSource \"infinite\" \"float scale\" 1e30 \"rgb L\" [1 1e30 1]",
        "LightSource \"distant\" \"float scale\" 1e30 \"rgb L\" [1 1 1e30]",
        "AreaLightSource \"diffuse\" \"float scale\" 1e30 \"rgb L\" [1e30 1 1]\n"
        "Shape \"disk\""}) {
    CHECK_THROWS_WITH(Compile(light), Contains("far.pbrt:5:") && Contains("3.4e38"));
  }
}

TEST_CASE("a camera and a plane beyond float32 are refused", "[compile]") {
  const std::string camera = "Camera \"perspective\"";
  CHECK_THROWS_WITH(Compile("", kFar + camera),
                    Contains("far.pbrt:2:") && Contains("this camera"));
  CHECK_THROWS_WITH(
      Compile("", "Camera \"orthographic\" \"float screenwindow\" [-1e30 1e30 -1 1]"),
      Contains("far.pbrt:1:") && Contains("as large as the scene"));
  CHECK_THROWS_WITH(Compile("", camera + " \"float lensradius\" 1e30"),
                    Contains("far.pbrt:1:") && Contains("as large as the scene"));
  CHECK_THROWS_AS(Compile("", "Scale 1e-200 1e-200 1e-200\n" + camera), InputError);
  CHECK_THROWS_WITH(Compile("Translate 0 0 3.5e38\nShape \"plane\""),
                    Contains("far.pbrt:6:") && Contains("this plane"));
  // The position of a plane's origin in the plane does not matter.
  CHECK(Compile("Translate 3.5e38 0 2\nShape \"plane\"").geometry.planes[0].point[2] !=
        0);
  CHECK(std::isfinite(
      Compile("", camera + " \"float lensradius\" 1 \"float focaldistance\" 1e30")
          .view.camera.focal_distance));
}

TEST_CASE("shapes too small beside the scene are left out with a note", "[compile]") {
  const std::string light = "AreaLightSource \"diffuse\"\n";
  const CompiledScene spheres =
      Compile(light + kFar + "Shape \"sphere\"\nShape \"disk\"");
  CHECK(spheres.geometry.spheres.empty());
  CHECK(spheres.geometry.disks.empty());
  CHECK(spheres.lights.lights.empty());
  CHECK_THAT(NotesOf(spheres), Contains("far.pbrt:3:") && Contains("far.pbrt:7:") &&
                                   Contains("far.pbrt:8:") && Contains("this disk") &&
                                   Contains("emits nothing"));
  const CompiledScene ring =
      Compile(light + "Shape \"disk\" \"float innerradius\" 0.99999999999");
  CHECK(ring.lights.lights.empty());
  CHECK_THAT(NotesOf(ring), Contains("far.pbrt:6:") && Contains("this disk"));
  const std::string object =
      "ObjectBegin \"o\"\nShape \"trianglemesh\" \"integer indices\" [0 1 2] "
      "\"point3 P\" [0 0 0 1 0 0 0 1 0]\nObjectEnd\n";
  const CompiledScene instances =
      Compile(object +
              "ObjectInstance \"o\"\nScale 1 1e-30 1\nObjectInstance \"o\"\n"
              "Scale 1 1 1e-10\nObjectInstance \"o\"\n");
  CHECK(instances.geometry.instances.size() == 1);
  CHECK_THAT(NotesOf(instances), Contains("far.pbrt:10:") && Contains("far.pbrt:12:"));
}

TEST_CASE("compiled media have finite values", "[compile]") {
  const std::string far =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
      "\"point3 P\" [0 0 0 1 0 0 0 1e60 1]\n";
  for (const char* type :
       {"\"homogeneous\" \"float scale\" 1e30", "\"cloud\" \"float density\" 1e30",
        "\"uniformgrid\" \"float scale\" 1e30 \"float density\" [1e30]",
        "\"rgbgrid\" \"float scale\" 1e30 \"rgb sigma_a\" [1e30 1 1] "
        "\"rgb sigma_s\" [1 1 1]"}) {
    INFO(type);
    const CompiledScene scene =
        Compile(far + "MediumInterface \"m\" \"\"\nTranslate 9 0 0\nShape \"plane\"",
                std::string("MakeNamedMedium \"m\" \"string type\" ") + type);
    REQUIRE(scene.media.media.size() == 1);
    const MediumRecord& m = scene.media.media[0];
    for (int c = 0; c < 3; ++c) {
      CHECK((m.sigma_t[c] >= 0 && m.sigma_t[c] <= kFarthestInScene));
      CHECK(m.sigma_s[c] <= m.sigma_t[c]);
    }
    for (const MediumGrid& grid : scene.media.grids) {
      for (const float v : grid.box_from_scene) CHECK(std::abs(v) <= kFarthestInScene);
      for (const float v : grid.majorants) {
        CHECK(double(v) * m.sigma_t[0] <= 1.001 * kFarthestInScene);
      }
    }
  }
}

}  // namespace lanelight::far_range
