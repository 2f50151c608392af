// The two estimators of the reference agree on every material, light and shape.
#include <catch2/catch.hpp>

#include "tests/reference/compare.h"
#include "tests/reference/scenes.h"

namespace lanelight::test {
namespace {

stat::ImageTestResult CompareEstimators(const SceneDescription& scene, int samples,
                                        double light_scale = 1) {
  const auto a =
      RenderReference(scene, Options(ReferenceEstimator::kMaterialSampling, samples));
  auto options = Options(ReferenceEstimator::kLightSampling, samples / 2);
  options.seed = 2;
  ReferenceImage b = RenderReference(scene, options);
  for (Rgb& m : b.mean) m *= light_scale;
  return stat::CompareMeans(Estimate(a), Estimate(b));
}

}  // namespace

TEST_CASE("reference: estimators agree on every material", "[reference]") {
  for (const Material& material : MaterialZoo()) {
    stat::CheckSame(CompareEstimators(Plate(material, 6), 1500), material.name);
  }
}

TEST_CASE("reference: estimators agree in a room, and a bias of 5 % is detected",
          "[reference]") {
  const SceneDescription scene = SmallRoom(8, 3, 0.95);
  stat::CheckSame(CompareEstimators(scene, 4000), 0.05);
  CHECK_FALSE(CompareEstimators(scene, 4000, 1.05).same);
}

TEST_CASE("reference: estimators agree on mixes, alpha, interfaces, power",
          "[reference]") {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 30);
  b.scene().film.imaging_ratio = 0.7;
  b.scene().filter.kind = FilterKind::kGaussian;
  b.Lens(0.05, 5);
  Material mix, nothing;
  mix.kind = MaterialKind::kMix;
  mix.mix[0] = b.AddDiffuse({0.2, 0.4, 0.8});
  mix.mix[1] = b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3);
  mix.mix_amount.constant = 0.3;
  nothing.kind = MaterialKind::kInterface;
  const Index invisible = b.AddMaterial(nothing);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddMaterial(mix));
  b.AddSphere({0.5, 0, 0.4}, 0.4, mix.mix[0]).alpha.constant = 0.6;
  b.AddSphere({-0.6, 0, 0.5}, 0.5, invisible);
  b.AddDisk({-0.6, 0, 0.5}, {0, -1, 1}, 0.3, invisible, b.AddEmission({1, 2, 3}, true));
  AreaLight powered;
  powered.power = 30;
  b.scene().area_lights.push_back(powered);
  b.AddQuad({-1, 1, 1}, {2, 0, 0}, {0, 0, 0.5}, mix.mix[0], 1);
  b.AddSpot({0, 0, 3}, {0, 0, 0}, {4, 4, 4}, 30, 10);
  b.AddDistant({1, 0, 2}, {0.3, 0.3, 0.2});
  stat::CheckSame(CompareEstimators(b.Build(), 4000));
}

TEST_CASE("reference: a render depends on its seed only", "[reference]") {
  const SceneDescription scene = SmallRoom(4, 3);
  auto options = Options(ReferenceEstimator::kLightSampling, 20);
  const auto a = RenderReference(scene, options), b = RenderReference(scene, options);
  CHECK(a.mean == b.mean);
  options.seed = 2;
  CHECK(RenderReference(scene, options).mean != a.mean);
}

}  // namespace lanelight::test
