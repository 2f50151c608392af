// Lights under transforms that stretch: the wavefront against the reference, which takes
// directions back to the light.
#include <catch2/catch.hpp>

#include "src/base/core/error.h"
#include "tests/agreement/agreement.h"
#include "tests/kernels/lights/image_strategies.h"

namespace lanelight::test {
namespace {

const Transform kStretch = Transform::Translate({0.2, 0.1, 2}) *
                           Transform::Rotate(50, {1, 0.3, -0.2}) *
                           Transform::Scale({1.6, 0.7, -1.1});

// A floor and a ball under two spots: only the first is stretched.
SceneDescription Spots(double cone, double delta) {
  SceneBuilder b(8, 8);
  b.Depth(1).Perspective({0, -4, 3}, {0, 0, 0}, {0, 0, 1}, 50);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5)));
  b.AddSphere({0.5, 0, 0.3}, 0.3, 0);
  b.AddSpot({0.1, 0, 0.2}, {0.2, -0.9, 1.4}, {3, 2, 1}, cone, delta);
  b.AddSpot({-1, 0, 2}, {-0.5, 0.3, 0}, {1, 2, 3}, 20, 10);
  SceneDescription scene = b.Build();
  scene.lights[0].world_from_light = kStretch;
  return scene;
}

}  // namespace

TEST_CASE("stretched spots render as the reference does", "[lights][agreement]") {
  CheckAgreementOnTargets(Spots(35, 15), 256, 256);
  CheckStrategies(Spots(35, 15));
  CheckStrategies(Spots(70, 30));
  CheckAgreement(Spots(120, 20), 512, 512, 0.2);  // more than a half space
}

TEST_CASE("a transform that nearly flattens a light is rendered or refused",
          "[lights][agreement]") {
  SceneDescription scene = Spots(35, 15);
  scene.lights[0].world_from_light = Transform::Scale({1, 1e-3, 1});
  stat::CheckSame(CompareWithReference(scene, 256, 256));
  scene.lights[0].world_from_light = Transform::Scale({1, 1e-25, 1});
  CHECK_THROWS_AS(RenderWavefront(scene, 1), InputError);
}

}  // namespace lanelight::test
