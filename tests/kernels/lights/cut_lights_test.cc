// Emitting shapes that alpha cuts: what shines is what is left, whether a ray meets it or
// a light sample finds it; and those of alpha 0, which shine unseen.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/pi.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/lights/cut_lamps.h"
#include "tests/kernels/lights/image_strategies.h"

namespace lanelight::test {
namespace {

// A square lamp over one pixel of floor.
constexpr double kLampRadiance = 2, kFloorAlbedo = 0.5, kLampHeight = 1, kLampHalf = 1;
SceneDescription LampOverFloor(double alpha) {
  SceneBuilder b(1, 1);
  b.Depth(1).Orthographic({0.3, 0.1, 0.5}, {0.3, 0.1, 0}, {0, 1, 0}, 1e-4);
  b.scene().textures = {Holes(4)};
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(kFloorAlbedo)));
  Shape& lamp = b.AddQuad({-kLampHalf, kLampHalf, kLampHeight}, {2 * kLampHalf, 0, 0},
                          {0, -2 * kLampHalf, 0}, b.AddDiffuse(Grey(0)),
                          b.AddEmission(Grey(kLampRadiance)));
  lamp.alpha.constant = alpha;
  if (alpha < 0) lamp.alpha.texture = 0;
  return b.Build();
}

// What pbrt-v4 makes of it: DiffuseAreaLight's SampleLi and L leave out the points that
// alpha cuts, so the floor has albedo / pi times the integral of L cos^2 / d^2 over what
// is left; here 4 x 4 cells to a side of the lamp, of which the first, at u = v = 0, is
// there.
double ExpectedFloor(bool holes) {
  constexpr int kSteps = 800;
  double sum = 0;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const double u = (i + 0.5) / kSteps, v = (j + 0.5) / kSteps;
      if (holes && (int(4 * u) + int(4 * v)) % 2 != 0) continue;
      const double x = 2 * kLampHalf * u - kLampHalf - 0.3,
                   y = kLampHalf - 2 * kLampHalf * v - 0.1;
      const double d2 = x * x + y * y + kLampHeight * kLampHeight;
      sum += kLampHeight * kLampHeight / (d2 * d2);
    }
  }
  const double area = 4 * kLampHalf * kLampHalf / (double(kSteps) * kSteps);
  return kFloorAlbedo / kPi * kLampRadiance * sum * area;
}

double FloorBy(const SceneDescription& scene, const char* strategy) {
  TestRender options;
  options.spp = 1 << 18;
  options.sampler = SampleSequence::kSobol;
  options.strategy = strategy;
  return RenderDescription(scene, options).film.Mean(0, 0).x;
}

bool HasStage(const SceneDescription& scene, const std::string& name) {
  const std::vector<PlannedStage> stages =
      MakePlan(PrepareScene(scene), {}).paths().stages;
  return std::any_of(stages.begin(), stages.end(), [&](const PlannedStage& planned) {
    return planned.stage.name == name;
  });
}

}  // namespace

TEST_CASE("lights with alpha textures agree with the reference", "[lights]") {
  CheckStrategies(CutLamps());
}

TEST_CASE("emitting spheres with alpha textures agree with the reference", "[lights]") {
  CheckStrategies(CutBalls());
}

TEST_CASE("lights of alpha 0 agree with the reference", "[lights]") {
  CheckStrategies(UnseenLamps());
}

TEST_CASE("a light with an alpha texture illuminates a floor as in pbrt", "[lights]") {
  // Rays meet alpha by chance: 0.5 % is the standard error of the worst of these.
  const auto expected = [](double value) { return Approx(value).epsilon(0.03); };
  const double whole = ExpectedFloor(false), holed = ExpectedFloor(true);
  CHECK(holed < 0.7 * whole);
  for (const char* strategy : {"directions=mis", "directions=light", "directions=bsdf",
                               "light-points=solid-angle,directions=light"}) {
    CAPTURE(strategy);
    CHECK(FloorBy(LampOverFloor(1), strategy) == expected(whole));
    CHECK(FloorBy(LampOverFloor(-1), strategy) == expected(holed));
    CHECK(FloorBy(LampOverFloor(0.25), strategy) == expected(whole / 4));
    CHECK(FloorBy(LampOverFloor(0), strategy) == expected(whole));
  }
}

TEST_CASE("scenes without alpha on lights have no stages for it", "[lights]") {
  CHECK(HasStage(CutLamps(), "light_emission_cut"));
  CHECK(HasStage(UnseenLamps(), "light_emission_cut"));
  SceneDescription whole = CutLamps();
  // Nor does a floor with holes.
  whole.shapes[0].alpha = whole.shapes[1].alpha;
  for (std::size_t i = 1; i < whole.shapes.size(); ++i)
    whole.shapes[i].alpha = {1, kNone};
  CHECK_FALSE(HasStage(whole, "light_emission_cut"));
}

}  // namespace lanelight::test
