// Coordinates that cannot be brought to unit size are errors with a place, near the limit
// scenes look as they do at any other size.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "src/base/core/error.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/geometry/geometry.h"
#include "src/scene/parse/parse.h"

namespace lanelight {
namespace {

using Catch::Contains;

CompiledScene Compile(const std::string& body) {
  const std::string text = "WorldBegin\nLightSource \"infinite\"\n" + body;
  return CompileScene(ParseSceneText(text, "far.pbrt", "."), {});
}

std::string Triangle(const std::string& size) {
  return fmt::format(
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  {0} 0 0  0 {0} 0 ] "
      "\"integer indices\" [ 0 1 2 ]\n",
      size);
}

}  // namespace

TEST_CASE("shapes beyond 1e100 are refused with their location", "[compile]") {
  for (const char* size : {"1e101", "1e150", "1e160", "1e200", "1e300"}) {
    INFO(size);
    CHECK_THROWS_WITH(Compile(Triangle(size)),
                      Contains("far.pbrt:3:") && Contains("beyond 1e+100 units"));
  }
  // The first of several, and what a transform makes of small numbers.
  const std::string near_and_far = Triangle("1") + Triangle("1e150") + Triangle("1e160");
  CHECK_THROWS_WITH(Compile(near_and_far), Contains("far.pbrt:4:"));
  for (const char* move : {"Translate 1e150 0 0\n", "Scale 1e200 1e200 1e200\n"}) {
    CHECK_THROWS_WITH(Compile(move + std::string("Shape \"sphere\"\n")),
                      Contains("far.pbrt:4:") && Contains("beyond"));
    CHECK_THROWS_WITH(Compile("ObjectBegin \"a\"\n" + Triangle("1") + "ObjectEnd\n" +
                              move + "ObjectInstance \"a\"\n"),
                      Contains("far.pbrt:7:") && Contains("this instance"));
  }
}

TEST_CASE("shapes that are too small together are refused", "[compile]") {
  CHECK_THROWS_WITH(Compile(Triangle("1e-101")),
                    Contains("far.pbrt:3:") && Contains("scale the scene up"));
  CHECK_THROWS_AS(Compile(Triangle("1e-300")), InputError);
}

TEST_CASE("scenes of 1e-100 to 1e100 units compile to the same triangles", "[compile]") {
  const CompiledScene unit = Compile(Triangle("1"));
  REQUIRE(unit.geometry.triangles.size() == 1);
  for (const char* size : {"2e-100", "1e-50", "1e-10", "1e10", "1e50", "0.9e100"}) {
    INFO(size);
    const CompiledScene scene = Compile(Triangle(size));
    REQUIRE(scene.geometry.triangles.size() == 1);
    const TriangleRecord &a = unit.geometry.triangles[0],
                         &b = scene.geometry.triangles[0];
    // Sizes are normalised to a power of two.
    const double ratio = double(b.p[1][0] - b.p[0][0]) / double(a.p[1][0] - a.p[0][0]);
    CHECK((ratio > 0.5 && ratio < 2.0));
    CHECK(b.p[2][1] - b.p[0][1] == Approx(b.p[1][0] - b.p[0][0]));
    CHECK(scene.scale * std::stod(size) == Approx(b.p[1][0] - b.p[0][0]));
  }
}

}  // namespace lanelight
