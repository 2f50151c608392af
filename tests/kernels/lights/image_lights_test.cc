// Goniometric and projection lights: samples against plain formulas, the power that is
// asked for, renders against the reference with every way of sampling.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "kernels/stages.h"
#include "src/base/core/pi.h"
#include "src/base/image/octahedral.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/lights/image_strategies.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/reference/lights.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

Light ImageLight(LightKind kind) {
  Light light;
  light.kind = kind;
  const bool square = kind == LightKind::kGoniometric;
  light.image_path = Picture(square ? "square.exr" : "wide.exr", square ? kSquare : kWide,
                             square ? kSquare : kHigh, Patchwork);
  light.emission = {2, 3, 4};
  light.fov = 70;
  // Mirrored, turned, scaled and moved.
  light.world_from_light = Transform::Translate({0.3, 0.5, 2}) *
                           Transform::Rotate(140, {1, 0.4, -0.2}) *
                           Transform::Scale({-1.5, 1.5, 1.5});
  return light;
}

Light Stretched(LightKind kind) {
  Light light = ImageLight(kind);
  light.world_from_light = light.world_from_light * Transform::Scale({0.6, 1.2, 0.8}) *
                           Transform::Rotate(25, {0, 1, 1});
  return light;
}

// Intensity towards the direction d of the light's own space. The centre of a goniometric
// map is the light's +y.
Rgb Intensity(const Light& light, Vec3d d) {
  if (light.kind == LightKind::kGoniometric) {
    const auto [s, t] = reference::GoniometricPlace(d);
    const Rgb texel = Patchwork(std::min(int(s * kSquare), kSquare - 1),
                                std::min(int(t * kSquare), kSquare - 1));
    return light.emission * ((texel.x + texel.y + texel.z) / 3);
  }
  if (d.z <= 0) return {};
  // The shorter side spans the field of view; +x is right, +y up.
  const double half = std::tan(light.fov / 2 * kPi / 180);
  const double x = d.x / d.z / half * kHigh / 2 + kWide / 2.0;
  const double y = kHigh / 2.0 - d.y / d.z / half * kHigh / 2;
  if (x < 0 || x >= kWide || y < 0 || y >= kHigh) return {};
  return light.emission * Patchwork(int(x), int(y));
}

SceneDescription Lit(const std::vector<Light>& lights) {
  SceneBuilder b(8, 8);
  b.Depth(1).Perspective({0, -4, 3}, {0, 0, 0}, {0, 0, 1}, 50);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5)));
  b.AddSphere({0.5, 0, 0.3}, 0.3, 0);
  SceneDescription scene = b.Build();
  scene.lights = lights;
  return scene;
}

// Which texel a direction falls into is not sure next to its edge.
bool NearEdge(const Light& light, Vec3d d) {
  const Rgb here = Intensity(light, d);
  for (int i = 0; i < 6; ++i) {
    Vec3d moved = d;
    moved[i / 2] += i % 2 == 0 ? 1e-5 : -1e-5;
    if (!(Intensity(light, moved) == here)) return true;
  }
  return false;
}

void CheckImageSamples(const std::vector<Light>& lights) {
  const PreparedScene scene = PrepareScene(Lit(lights));
  WaveFixture fixture(scene.Parts(), kImagePaths);
  PathColumns& p = fixture.wave.path;
  p.light_pmf = nullptr;
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> place(-3, 3);
  for (std::uint32_t i = 0; i < kImagePaths; ++i) {
    p.p_x[i] = place(engine), p.p_y[i] = place(engine), p.p_z[i] = place(engine);
    p.ls_light[i] = engine() % static_cast<std::uint32_t>(lights.size());
  }
  fixture.QueueAll(QueueId::kLit, kImagePaths);
  FeatureSet features = scene.compiled->features;
  fixture.Run(SampleImageLightStage, features);
  std::uint32_t lit = 0;
  for (std::uint32_t i = 0; i < kImagePaths; ++i) {
    const std::size_t chosen = lights.size() > 1 ? p.ls_light[i] : 0;
    const Light& light = lights[chosen];
    const Vec3d at = Vec3d{p.p_x[i], p.p_y[i], p.p_z[i]} / scene.compiled->scale +
                     scene.compiled->center;
    const Vec3d to = light.world_from_light.Point({0, 0, 0}) - at;
    const Vec3d away = light.world_from_light.Inverse().Vector(Normalize(-to));
    INFO("path " << i << ", light " << chosen);
    CHECK(Length(Vec3d{p.ls_x[i], p.ls_y[i], p.ls_z[i]} - Normalize(to)) < 1e-5);
    CHECK(p.ls_distance[i] == Approx(Length(to) * scene.compiled->scale).epsilon(1e-5));
    CHECK(p.ls_pdf[i] == 0);
    if (NearEdge(light, away)) continue;
    const Rgb want =
        Intensity(light, away) / (Dot(to, to) * double(scene.chances->pmf[chosen]));
    const float* columns[3] = {p.ls_r, p.ls_g, p.ls_b};
    for (int c = 0; c < 3; ++c) {
      CHECK(columns[c][i] == Approx(want[c]).epsilon(2e-5));
    }
    lit += want.x > 0;
  }
  CHECK(lit > kImagePaths / 20);
}

}  // namespace

TEST_CASE("samples of image lights are what the image says", "[lights]") {
  const Light map = ImageLight(LightKind::kGoniometric);
  const Light slide = ImageLight(LightKind::kProjection);
  Light tall = slide;
  tall.world_from_light = Transform::Translate({-1, 0, 1});
  const EachTarget target;
  CheckImageSamples({map});
  CheckImageSamples({slide});
  CheckImageSamples({map, slide, tall});
  CheckImageSamples({Stretched(LightKind::kGoniometric)});
  CheckImageSamples({Stretched(LightKind::kProjection), map});
}

TEST_CASE("image lights have the specified power", "[lights]") {
  for (const LightKind kind : {LightKind::kGoniometric, LightKind::kProjection}) {
    Light light = ImageLight(kind);
    light.emission = {1, 1, 1};
    light.power = 50;
    const CompiledScene scene = CompileScene(Lit({light}));
    REQUIRE(scene.lights.lights.size() == 1);
    light.emission =
        Rgb{1, 1, 1} * (scene.lights.lights[0].radiance[0] / (scene.scale * scene.scale));
    // Over the sphere, in steps of equal solid angle.
    double power = 0;
    constexpr int kSteps = 1200;
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const Vec3d d =
          OctahedralToDirection((i % kSteps + 0.5) / kSteps, (i / kSteps + 0.5) / kSteps);
      power += Luminance(Intensity(light, d)) * 4 * kPi / (double(kSteps) * kSteps);
    }
    // pbrt takes the cosine at the middle of each of few pixels.
    CHECK(power == Approx(50).epsilon(kind == LightKind::kGoniometric ? 1e-4 : 0.02));
    CHECK(scene.lights.power[0] / (scene.scale * scene.scale) ==
          Approx(50).epsilon(1e-5));
  }
}

// pbrt-v4 multiplies I and scale by power / k_e; k_e has the image alone.
TEST_CASE("power of image lights multiplies their colour and scale", "[lights]") {
  for (const LightKind kind : {LightKind::kGoniometric, LightKind::kProjection}) {
    Light light = ImageLight(kind);
    light.power = 50;
    light.emission = {1, 1, 1};
    const CompiledScene one = CompileScene(Lit({light}));
    light.emission = {2, 3, 4};
    const CompiledScene coloured = CompileScene(Lit({light}));
    for (int c = 0; c < 3; ++c) {
      CHECK(coloured.lights.lights[0].radiance[c] ==
            Approx((2 + c) * one.lights.lights[0].radiance[c]));
    }
  }
}

TEST_CASE("image lights agree with the reference", "[lights]") {
  CheckStrategies(
      Lit({ImageLight(LightKind::kGoniometric), ImageLight(LightKind::kProjection)}));
  CheckStrategies(
      Lit({Stretched(LightKind::kGoniometric), Stretched(LightKind::kProjection)}));
}

TEST_CASE("scenes without light images have no stages for them", "[lights]") {
  const PreparedScene scene = PrepareScene(PolygonLight(8));
  CHECK(scene.compiled->lights.images.empty());
  CHECK(scene.compiled->lights.texels.empty());
  CHECK(scene.compiled->lights.portals.empty());
  CHECK(scene.compiled->geometry.uvs.empty());
  const Plan plan = MakePlan(scene, {});
  for (const PlannedStage& planned : plan.paths().stages) {
    const std::string name = planned.stage.name;
    CHECK(name != "light_image");
    CHECK(name != "light_emission_image");
    CHECK(name != "light_portal");
  }
}

}  // namespace lanelight::test
