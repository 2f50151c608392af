// Media rendered by the wavefront and by the scalar reference, whose random walks are
// analog and in one channel at a time: tile by tile, within confidence limits of one
// family-wise false-alarm budget (1e-6 each image). Each also says how large a bias it
// would have found.
#include <catch2/catch.hpp>

#include "kernels/simd/target.h"
#include "tests/agreement/agreement.h"
#include "tests/kernels/media/scenes.h"

namespace lanelight::test {

TEST_CASE("media: fog around camera and lights", "[media][agreement]") {
  CheckAgreement(Fog(), 8192, 12000, 0.09);
}

TEST_CASE("media: clouds within clouds, behind interfaces", "[media][agreement]") {
  CheckAgreement(NestedClouds(), 4096, 2500, 0.08);
}

TEST_CASE("media: liquid in glass in fog", "[media][agreement]") {
  CheckAgreement(FilledGlass(), 4096, 2500, 0.12);
}

TEST_CASE("media: densities and colours that vary", "[media][agreement]") {
  CheckAgreement(Smoke(), 4096, 3000, 0.12);
}

TEST_CASE("media: absorbers only", "[media][agreement]") {
  SceneDescription scene = NestedClouds();
  for (Medium& medium : scene.media) medium.sigma_s = {};
  CheckAgreement(scene, 2048, 2000, 0.08);
}

TEST_CASE("media: on every target", "[media][agreement]") {
  CheckAgreementOnTargets(NestedClouds(), 512, 1500);
}

TEST_CASE("media: the agreement tests detect a planted bias", "[media][agreement]") {
  const SceneDescription scene = NestedClouds();
  const auto reference =
      Estimate(RenderReference(scene, Options(ReferenceEstimator::kLightSampling, 1500)));
  SceneDescription thicker = scene;
  thicker.media[0].sigma_s *= 2.5;
  CHECK_FALSE(stat::CompareMeans(RenderWavefront(thicker, 4096), reference).same);
  SceneDescription turned = scene;
  for (Medium& medium : turned.media) medium.g = -medium.g;
  CHECK_FALSE(stat::CompareMeans(RenderWavefront(turned, 4096), reference).same);
}

}  // namespace lanelight::test
