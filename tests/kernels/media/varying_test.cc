// Media that vary: clouds, NanoVDB grids, emission by voxel. Each against the scalar
// reference within confidence limits of a family-wise false-alarm budget of 1e-6 an
// image, and constants against closed forms.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/image/spectrum.h"
#include "tests/agreement/agreement.h"
#include "tests/kernels/media/varying_scenes.h"

namespace lanelight::test {
namespace {

constexpr Rgb kThickness = {0.3, 1, 2.5};

// Returns the light of the slab for `emission`, without absorption in front.
Rgb SlabOf(Rgb emission) {
  const auto fraction = [](double sigma) { return 1 - std::exp(-sigma * 0.8); };
  return emission *
         Rgb{fraction(kThickness.x), fraction(kThickness.y), fraction(kThickness.z)};
}

void CheckSlab(const SceneDescription& scene, Rgb expected) {
  const auto known = stat::ExpectedImage(4, 4, [&](int, int) { return expected; });
  stat::CheckSame(stat::CompareMeans(RenderWavefront(scene, 1 << 14), known,
                                     {4, 1e-6, kFloatTolerance, 1e-7}),
                  0.05);
}

// Counts of samples: such that a bias of 10 % of the whole image is found. What can be
// found falls with the root of the counts; 1024 and 400 samples (600 of the grid) found
// 8.7 % with the cloud, 10.1 % with NanoVDB, 7.2 % with the grid. Counts are multiplied
// by the square of that over 10 %, and by 1.5 for what variances are estimated wrongly,
// rounded up to a doubling. Twice as many, at length, find 10 % over the root of 2.
void CheckBall(const Medium& medium, std::uint64_t spp, int reference_spp, double power) {
  stat::CheckSame(CompareWithReference(BallOf(medium), spp, reference_spp), power);
}

}  // namespace

TEST_CASE("media: constant grids of all kinds are homogeneous", "[media][closed-form]") {
  const TemporaryFolder folder;
  const Medium sparse = ConstantSparse(folder.File("a.nvdb"), kThickness, {});
  for (const Medium& medium : {ConstantGrid(kThickness, {}), sparse}) {
    CheckSlab(Slab(medium, {1, 2, 3}), Rgb{1, 2, 3} - SlabOf({1, 2, 3}));
  }
  // A cloud is solid up to a height of 0.
  Medium cloud = MakeMedium(kThickness, {});
  cloud.kind = MediumKind::kCloud;
  cloud.box_min = {-8, -8, -8};
  cloud.box_max = {8, 8, 8};
  cloud.world_from_medium = Transform::Translate({0, 4, 0});
  CheckSlab(Slab(cloud, {1, 2, 3}), Rgb{1, 2, 3} - SlabOf({1, 2, 3}));
}

TEST_CASE("media: emission of a slab of black bodies", "[media][closed-form]") {
  const TemporaryFolder folder;
  Medium grid = ConstantGrid(kThickness, {});
  grid.temperature.assign(64, 7.0f);
  grid.temperature_offset = 1, grid.temperature_scale = 300;
  grid.emission = {0.1, 0.1, 0.1};
  grid.emission_grid.assign(64, 2.0f);
  CheckSlab(Slab(grid), SlabOf(0.2 * RgbOfBlackbody(1800)));
  Medium sparse = ConstantSparse(folder.File("a.nvdb"), kThickness, {}, 2500);
  sparse.emission = {0.1, 0.1, 0.1};
  CheckSlab(Slab(sparse), SlabOf(0.1 * RgbOfBlackbody(2500)));
  // Up to 100 kelvin there is none.
  grid.temperature_scale = 16;
  CheckSlab(Slab(grid, {1, 2, 3}), Rgb{1, 2, 3} - SlabOf({1, 2, 3}));
}

TEST_CASE("media: emission without Lescale falls to half at the sides of the box",
          "[media][closed-form]") {
  // One voxel across the view: density and scale are both 1 - |z| / 0.8 at z.
  Medium medium = MakeMedium(kThickness, {}, 0, {1, 2, 3});
  medium.kind = MediumKind::kUniformGrid;
  medium.grid = {1}, medium.emission_grid = {1};
  medium.box_min = {-1e5, -1e5, -0.4};
  medium.box_max = {1e5, 1e5, 0.4};
  Rgb expected;
  constexpr int kSteps = 100000;
  constexpr double kStep = 0.8 / kSteps;
  double depth = 0;  // of a coefficient of 1, up to the middle of a step
  for (int i = 0; i < kSteps; ++i) {
    const double tent = 1 - std::abs(-0.4 + (i + 0.5) * kStep) / 0.8;
    depth += tent * kStep / 2;
    for (int c = 0; c < 3; ++c) {
      const double sigma = kThickness[c];
      expected[c] +=
          medium.emission[c] * sigma * tent * tent * std::exp(-sigma * depth) * kStep;
    }
    depth += tent * kStep / 2;
  }
  CheckSlab(Slab(medium), expected);
}

TEST_CASE("media: colours that a slab emits", "[media][closed-form]") {
  Medium medium = ConstantGrid({}, {});
  medium.kind = MediumKind::kRgbGrid;
  medium.grid.clear();
  for (int v = 0; v < 64; ++v) {
    for (const float c : {0.3f, 1.0f, 2.5f, 0.0f, 0.0f, 0.0f}) medium.grid.push_back(c);
    for (const float c : {1.0f, 2.0f, 3.0f}) medium.emission_grid.push_back(c);
  }
  medium.emission = {0.5, 0.5, 0.5};
  CheckSlab(Slab(medium), SlabOf({0.5, 1, 1.5}));
}

TEST_CASE("media: a cloud", "[media][agreement]") {
  CheckBall(CloudLump(), 2048, 800, 0.1);
}

TEST_CASE("media: NanoVDB grids of densities and temperatures", "[media][agreement]") {
  const TemporaryFolder folder;
  CheckBall(SparseLump(folder), 2048, 800, 0.1);
}

TEST_CASE("media: scales of emission and temperatures by voxel", "[media][agreement]") {
  Medium lump = MakeMedium({0.4, 0.8, 1.5}, {2, 1.5, 1}, 0.4, {0.02, 0.02, 0.02});
  lump.kind = MediumKind::kUniformGrid;
  lump.grid_size[0] = 4, lump.grid_size[1] = 3, lump.grid_size[2] = 5;
  for (int i = 0; i < 60; ++i) {
    lump.grid.push_back(0.3f * static_cast<float>(i % 5));
    lump.emission_grid.push_back(i % 6 == 2 ? 3.0f : 0.5f);
    lump.temperature.push_back(800.0f + 300.0f * static_cast<float>(i % 7));
  }
  lump.box_min = {-1, -1, 0};
  lump.box_max = {1, 1, 2};
  CheckBall(lump, 1024, 600, 0.1);
}

TEST_CASE("media: a cloud and NanoVDB grids, at length", "[media][agreement][slow]") {
  const TemporaryFolder folder;
  CheckBall(CloudLump(), 4096, 1600, 0.071);
  CheckBall(SparseLump(folder), 4096, 1600, 0.071);
}

TEST_CASE("media: the tests of varying media detect a planted bias",
          "[media][agreement]") {
  const auto reference = Estimate(RenderReference(
      BallOf(CloudLump()), Options(ReferenceEstimator::kLightSampling, 400)));
  Medium wrong = CloudLump();
  wrong.density = 1;
  CHECK_FALSE(stat::CompareMeans(RenderWavefront(BallOf(wrong), 1024), reference).same);
}

}  // namespace lanelight::test
