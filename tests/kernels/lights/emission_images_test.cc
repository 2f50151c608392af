// Emitting shapes with images: samples against the reference's surfaces, renders against
// the reference with every way of sampling. A picture that is upside down is found.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "kernels/stages.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/lights/image_strategies.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

// Emitting shapes of every kind with images, one of them without.
SceneDescription Pictures() {
  SceneBuilder b(8, 8);
  b.Depth(2).Perspective({0, -4, 2.2}, {0, 0, 0.7}, {0, 0, 1}, 50);
  const Index ground = b.AddDiffuse({0.6, 0.5, 0.4});
  b.AddPlane({0, 0, 0}, {0, 0, 1}, ground);
  const std::string path = Picture("wide.exr", kWide, kHigh, Patchwork);
  const auto picture = [&](Rgb scale, bool two_sided) {
    const Index light = b.AddEmission(scale, two_sided);
    b.scene().area_lights[static_cast<std::size_t>(light)].image_path = path;
    return light;
  };
  b.AddQuad({-1.6, 0.6, 0.4}, {0, 0, 0.9}, {1.3, 0, 0}, ground,
            picture({2, 3, 1}, false));
  TriangleMesh sail;
  sail.positions = {{0.1, 0.4, 0.2}, {1.1, 0.2, 0.3}, {0.6, 0.5, 1.3}};
  sail.uvs = {{0.9, 0.1}, {0.2, 0.3}, {0.4, 1.2}};
  sail.indices = {0, 1, 2};
  b.AddMesh(sail, ground, picture({3, 3, 3}, true));
  b.AddSphere({-0.5, -0.8, 0.45}, 0.35, ground, picture({1, 2, 3}, true))
      .world_from_object = Transform::Translate({-0.5, -0.8, 0.45}) *
                           Transform::Rotate(50, {1, 2, 0.5}) *
                           Transform::Scale({1, -1, 1});
  b.AddDisk({1.2, -0.6, 0.8}, {-0.4, -0.5, 0.8}, 0.4, ground, picture({2, 2, 2}, true));
  b.AddDisk({0, 0, 2.5}, {0, 0, -1}, 0.3, ground, b.AddEmission({3, 3, 3}));
  return b.Build();
}

}  // namespace

TEST_CASE("textured lights agree with the reference", "[lights]") {
  CheckStrategies(Pictures());
}

TEST_CASE("an emission image that is upside down is detected", "[lights]") {
  const auto truth = Estimate(
      RenderReference(Pictures(), Options(ReferenceEstimator::kLightSampling, 4096)));
  SceneDescription turned = Pictures();
  const std::string path = Picture("turned.exr", kWide, kHigh, [](int x, int y) {
    return Patchwork(x, kHigh - 1 - y);
  });
  for (AreaLight& light : turned.area_lights) {
    if (!light.image_path.empty()) light.image_path = path;
  }
  const auto result = stat::CompareMeans(RenderBy(turned, "directions=mis"), truth,
                                         {4, 1e-5, kFloatTolerance, 1e-7});
  CHECK_FALSE(result.same);
}

TEST_CASE("samples on emitting shapes have the image of their point", "[lights]") {
  const SceneDescription description = Pictures();
  const reference::Geometry geometry(description, {});
  Texture picture;
  picture.kind = TextureKind::kImage;
  picture.path = description.area_lights[0].image_path;
  picture.wrap = WrapMode::kClamp;
  const std::vector<Texture> images = {picture};
  const reference::Textures textures(images);
  const PreparedScene scene = PrepareScene(description);
  const EachTarget target;
  WaveFixture fixture(scene.Parts(), kImagePaths);
  fixture.run.features = scene.compiled->features;
  PathColumns& p = fixture.wave.path;
  p.light_pmf = nullptr;
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> place(-2, 2), unit(0, 1);
  for (std::uint32_t i = 0; i < kImagePaths; ++i) {
    p.p_x[i] = place(engine), p.p_y[i] = place(engine), p.p_z[i] = place(engine);
    p.p_error[i] = 1e-6f;
    p.u_light_0[i] = unit(engine), p.u_light_1[i] = unit(engine);
    p.ls_light[i] =
        engine() % static_cast<std::uint32_t>(scene.compiled->lights.lights.size());
  }
  fixture.QueueAll(QueueId::kLit, kImagePaths);
  for (const StageOn stage : {SampleTriangleLightStage, SampleRectangleLightStage,
                              SampleSphereLightStage, SampleDiskLightStage}) {
    fixture.Run(stage, scene.compiled->features);
  }
  const std::vector<float> before(p.ls_r, p.ls_r + kImagePaths);
  fixture.Run(EmissionImageSamplesStage, scene.compiled->features);
  std::uint32_t checked = 0;
  for (std::uint32_t i = 0; i < kImagePaths; ++i) {
    const Vec3d from = Vec3d{p.p_x[i], p.p_y[i], p.p_z[i]} / scene.compiled->scale +
                       scene.compiled->center;
    const reference::Ray ray = {from, Normalize(Vec3d{p.ls_x[i], p.ls_y[i], p.ls_z[i]}),
                                kNone};
    if (!(before[i] > 0)) continue;
    // The emitter that lies where the sample ends.
    double nearest = 1e-4;
    Rgb want;
    for (int k = 0; k < static_cast<int>(geometry.primitives().size()); ++k) {
      const reference::Primitive& shape = geometry.primitives()[std::size_t(k)];
      reference::Hit hits[2];
      const int count = reference::IntersectPrimitive(shape, ray, false, hits);
      for (int h = 0; h < count && shape.area_light != kNone; ++h) {
        const double off = std::abs(hits[h].t - p.ls_distance[i] / scene.compiled->scale);
        if (off > nearest) continue;
        nearest = off;
        hits[h].primitive = k;
        const reference::SurfacePoint at = geometry.Describe(ray, hits[h]);
        const AreaLight& light = description.area_lights[std::size_t(shape.area_light)];
        want = light.image_path.empty() ? Rgb{1, 1, 1} : textures.Eval(0, at.u, at.v);
      }
    }
    if (nearest == 1e-4) continue;  // grazing: rays end in front of the light
    INFO("path " << i << ", light " << p.ls_light[i]);
    CHECK(p.ls_r[i] / before[i] == Approx(want.x).epsilon(5e-3).margin(2e-3));
    ++checked;
  }
  CHECK(checked > kImagePaths / 2);
}

}  // namespace lanelight::test
