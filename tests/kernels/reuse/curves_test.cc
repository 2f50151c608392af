// reuse=block beside curves, whose flat and cylindrical types turn towards the ray that
// meets them: the second vertices of one path are not those of another.
#include <catch2/catch.hpp>

#include "src/scene/parse/parse.h"
#include "tests/bias/tile_bias.h"

namespace lanelight::test {
namespace {

// Bright, wide curves over a floor, which gets most of its light from them.
std::string CurvesOverFloor(const std::string& type) {
  return R"(
LookAt 0 3 -4  0 0.4 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
PixelFilter "box"
Integrator "path" "integer maxdepth" 3
WorldBegin
LightSource "point" "point3 from" [ 0 0.35 0 ] "rgb I" [ 1 1 1 ]
Material "diffuse" "rgb reflectance" [ 0.1 0.1 0.1 ]
AttributeBegin
  Rotate -90 1 0 0
  Shape "plane"
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.9 0.9 0.9 ]
Shape "curve" "string type" ")" +
         type + R"(" "float width" 0.7
  "point3 P" [ -1 0.5 0.6  -0.4 0.7 0.7  0.4 0.7 0.7  1 0.5 0.6 ]
Shape "curve" "string type" ")" +
         type + R"(" "float width" 0.7
  "point3 P" [ -1 0.5 -0.6  -0.4 0.7 -0.7  0.4 0.7 -0.7  1 0.5 -0.6 ]
)";
}

}  // namespace

TEST_CASE("second vertices on curves are not reused by other paths", "[reuse][bias]") {
  for (const char* type : {"flat", "cylinder"}) {
    INFO(type);
    const SceneDescription scene =
        ParseSceneText(CurvesOverFloor(type), "curves.pbrt", ".");
    BiasTest test(PrepareScene(scene), "roulette=none",
                  {{64, 32, 1e-3}, {64, 128, 1e-3}});
    const BiasVerdict verdict = test.Compare("roulette=none,reuse=block:64");
    INFO(verdict.worst);
    CHECK_FALSE(verdict.biased);
    CHECK_FALSE(verdict.identical);
    CHECK(verdict.tile_power < 0.01);
  }
}

}  // namespace lanelight::test
