// Lights with images: samples of goniometric and projection lights against plain
// formulas, portals against the rectangle that they are, and renders against the
// reference with every way of sampling. Planted faults are found.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "kernels/simd/target.h"
#include "kernels/stages.h"
#include "src/core/error.h"
#include "src/core/pi.h"
#include "src/image/octahedral.h"
#include "src/prepare/parameters.h"
#include "src/prepare/prepare_scene.h"
#include "src/stat/hypothesis.h"
#include "tests/lights/pictures.h"
#include "tests/support/wave_fixture.h"
#include "tests/wavefront/agreement.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kPaths = 4001;
constexpr int kWide = 6, kHigh = 4, kSquare = 8;

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

// Intensity towards the unit direction d of the light's own space. The centre of a
// goniometric map is the light's +y.
Rgb Intensity(const Light& light, Vec3d d) {
  if (light.kind == LightKind::kGoniometric) {
    const auto [s, t] = DirectionToOctahedral({d.x, d.z, d.y});
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
    if (!(Intensity(light, Normalize(moved)) == here)) return true;
  }
  return false;
}

void CheckImageSamples(const std::vector<Light>& lights) {
  const CompiledScene scene = PrepareScene(Lit(lights));
  WaveFixture fixture(scene, kPaths);
  PathColumns& p = fixture.wave.path;
  p.light_pmf = nullptr;
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> place(-3, 3);
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    p.p_x[i] = place(engine), p.p_y[i] = place(engine), p.p_z[i] = place(engine);
    p.ls_light[i] = engine() % static_cast<std::uint32_t>(lights.size());
  }
  fixture.QueueAll(QueueId::kLit, kPaths);
  FeatureSet features = scene.features;
  fixture.Run(SampleImageLightStage(), features);
  std::uint32_t lit = 0;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const std::size_t chosen = lights.size() > 1 ? p.ls_light[i] : 0;
    const Light& light = lights[chosen];
    const Vec3d at = Vec3d{p.p_x[i], p.p_y[i], p.p_z[i]} / scene.scale + scene.center;
    const Vec3d to = light.world_from_light.Point({0, 0, 0}) - at;
    const Vec3d away = Normalize(light.world_from_light.Inverse().Vector(-to));
    INFO("path " << i << ", light " << chosen);
    CHECK(Length(Vec3d{p.ls_x[i], p.ls_y[i], p.ls_z[i]} - Normalize(to)) < 1e-5);
    CHECK(p.ls_distance[i] == Approx(Length(to) * scene.scale).epsilon(1e-5));
    CHECK(p.ls_pdf[i] == 0);
    if (NearEdge(light, away)) continue;
    const Rgb want =
        Intensity(light, away) / (Dot(to, to) * double(scene.lights.lights[chosen].pmf));
    const float* columns[3] = {p.ls_r, p.ls_g, p.ls_b};
    for (int c = 0; c < 3; ++c) {
      CHECK(columns[c][i] == Approx(want[c]).epsilon(2e-5));
    }
    lit += want.x > 0;
  }
  CHECK(lit > kPaths / 20);
}

// A hall that the sky enters through a window in its side x = 2, for portals.
constexpr double kSill = 0.5, kTop = 1.7, kLeft = -0.8, kRight = 0.9;
std::vector<Vec3d> Window() {
  return {{2, kLeft, kSill}, {2, kLeft, kTop}, {2, kRight, kTop}, {2, kRight, kSill}};
}

SceneDescription Hall() {
  SceneBuilder b(8, 8);
  b.Depth(2).Perspective({-1.8, -1.6, 1}, {2, 0.6, 1}, {0, 0, 1}, 75);
  const Index wall = b.AddDiffuse({0.6, 0.5, 0.4});
  b.AddQuad({-4, -2, 0}, {6, 0, 0}, {0, 4, 0}, wall);
  b.AddQuad({-4, -2, 2}, {0, 4, 0}, {6, 0, 0}, wall);
  b.AddQuad({-4, 2, 0}, {6, 0, 0}, {0, 0, 2}, wall);
  // The wall around the window.
  b.AddQuad({2, -2, 0}, {0, 4, 0}, {0, 0, kSill}, wall);
  b.AddQuad({2, -2, kTop}, {0, 4, 0}, {0, 0, 2 - kTop}, wall);
  b.AddQuad({2, -2, kSill}, {0, 2 + kLeft, 0}, {0, 0, kTop - kSill}, wall);
  b.AddQuad({2, kRight, kSill}, {0, 2 - kRight, 0}, {0, 0, kTop - kSill}, wall);
  b.AddEnvironment({1, 2, 3});
  SceneDescription scene = b.Build();
  scene.lights.back().portal = Window();
  return scene;
}

SceneDescription HallUnderMap() {
  SceneDescription scene = Hall();
  Light& sky = scene.lights.back();
  sky.image_path = Picture("sky.exr", kSquare, kSquare, Patchwork);
  sky.emission = {1, 1, 1};
  sky.image_scale = 1.5;
  sky.world_from_light = Transform::Rotate(35, {0.3, 1, 0.2});
  return scene;
}

// Van Oosterom and Strackee 1983.
double SolidAngleOfTriangle(Vec3d a, Vec3d b, Vec3d c) {
  const double x = Length(a), y = Length(b), z = Length(c);
  return 2 * std::abs(std::atan2(Dot(a, Cross(b, c)), x * y * z + Dot(a, b) * z +
                                                          Dot(b, c) * x + Dot(c, a) * y));
}

struct PortalSamples {
  CompiledScene scene;
  WaveFixture fixture;

  // All from one place of the world, with evenly spread numbers.
  PortalSamples(const SceneDescription& description, Vec3d from)
      : scene(PrepareScene(description)), fixture(scene, kPaths) {
    PathColumns& p = fixture.wave.path;
    p.light_pmf = nullptr;
    const Vec3d at = (from - scene.center) * scene.scale;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.p_x[i] = float(at.x), p.p_y[i] = float(at.y), p.p_z[i] = float(at.z);
      p.o_x[i] = p.p_x[i], p.o_y[i] = p.p_y[i], p.o_z[i] = p.p_z[i];
      p.u_light_0[i] = (float(i) + 0.5f) / kPaths;
      const double golden = 0.5 + i * 0.6180339887498949;
      p.u_light_1[i] =
          float(std::floor((golden - std::floor(golden)) * 0x1p24) * 0x1p-24);
      p.ls_light[i] = 0;
    }
    fixture.QueueAll(QueueId::kLit, kPaths);
    fixture.Run(SamplePortalLightStage(), scene.features);
  }
};

// All ways to sample lights that know of their emission.
constexpr const char* kStrategies[] = {
    "directions=mis",
    "directions=light,light-selection=tree",
    "directions=bsdf,seen-lights=paths",
    "light-points=solid-angle,light-candidates=resampled:4",
    "light-points=projected,directions=light",
    "control=analytic,c=1",
    "control=ambient,c=1",
    "guiding=radiance,environment=compensated"};

stat::ImageEstimate RenderBy(const SceneDescription& scene, const char* strategy) {
  TestRender options;
  options.spp = 2048;
  options.strategy = strategy;
  options.planned_samples = 4096;
  const Rendered render = RenderDescription(scene, options);
  CHECK(render.result.health.Total() == 0);
  return Estimate(render);
}

bool Refused(const SceneDescription& scene, const char* strategy) {
  SceneDescription copy = scene;
  ApplyStrategy(strategy, {}, copy.strategy);
  try {
    MakePlan(PrepareScene(copy), {});
    return false;
  } catch (const InputError&) {
    return true;
  }
}

// Family-wise false alarms of a scene's comparisons: 1e-5.
void CheckStrategies(const SceneDescription& scene) {
  const auto truth = Estimate(
      RenderReference(scene, Options(ReferenceEstimator::kLightSampling, 20000)));
  const auto other = Estimate(
      RenderReference(scene, Options(ReferenceEstimator::kMaterialSampling, 20000)));
  const stat::ImageTestOptions test = {
      4, stat::SidakLevel(1e-5, int(std::size(kStrategies)) + 1), kFloatTolerance, 1e-7};
  const auto twins = stat::CompareMeans(truth, other, test);
  INFO(twins.ToString());
  CHECK(twins.same);
  for (const char* strategy : kStrategies) {
    if (Refused(scene, strategy)) continue;
    const auto result = stat::CompareMeans(RenderBy(scene, strategy), truth, test);
    INFO(strategy << ": " << result.ToString());
    CHECK(result.same);
    CHECK(result.detectable_bias < 0.2);
  }
}

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

TEST_CASE("samples of image lights are what the image says", "[lights]") {
  const Light map = ImageLight(LightKind::kGoniometric);
  const Light slide = ImageLight(LightKind::kProjection);
  Light tall = slide;
  tall.world_from_light = Transform::Translate({-1, 0, 1});
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    CAPTURE(target);
    CheckImageSamples({map});
    CheckImageSamples({slide});
    CheckImageSamples({map, slide, tall});
  }
  ForceTarget("");
}

TEST_CASE("image lights have the power that is asked for", "[lights]") {
  for (const LightKind kind : {LightKind::kGoniometric, LightKind::kProjection}) {
    Light light = ImageLight(kind);
    light.emission = {1, 1, 1};
    light.power = 50;
    const CompiledScene scene = PrepareScene(Lit({light}));
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

TEST_CASE("portal samples cover the window as densely as they say", "[lights]") {
  const Vec3d places[] = {{0, 0, 1}, {1.9, -0.7, 0.1}, {-1.5, 1.5, 1.8}};
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    for (const Vec3d from : places) {
      CAPTURE(target, from.x, from.y, from.z);
      const auto w = Window();
      const double angle = SolidAngleOfTriangle(w[0] - from, w[1] - from, w[2] - from) +
                           SolidAngleOfTriangle(w[0] - from, w[2] - from, w[3] - from);
      for (const SceneDescription& hall : {Hall(), HallUnderMap()}) {
        PortalSamples s(hall, from);
        const PathColumns& p = s.fixture.wave.path;
        double covered = 0;
        for (std::uint32_t i = 0; i < kPaths; ++i) {
          REQUIRE(p.ls_pdf[i] > 0);
          const Vec3d d = {p.ls_x[i], p.ls_y[i], p.ls_z[i]};
          const Vec3d q = from + d * ((2 - from.x) / d.x);
          CHECK((d.x > 0 && q.y > kLeft - 1e-3 && q.y < kRight + 1e-3));
          CHECK((q.z > kSill - 1e-3 && q.z < kTop + 1e-3));
          covered += 1 / (double(p.ls_pdf[i]) * kPaths);
        }
        CHECK(covered == Approx(angle).epsilon(0.01));
      }
    }
    // Outside there is nothing to be seen through it.
    PortalSamples outside(Hall(), {2.5, 0, 1});
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      CHECK(outside.fixture.wave.path.ls_r[i] == 0);
    }
  }
  ForceTarget("");
}

TEST_CASE("a ray through a portal knows the density of its sample", "[lights]") {
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    CAPTURE(target);
    PortalSamples s(HallUnderMap(), {0.5, 0.3, 0.6});
    PathColumns& p = s.fixture.wave.path;
    s.fixture.run.mis = MakeMisParameters(Strategy{});
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.d_x[i] = p.ls_x[i], p.d_y[i] = p.ls_y[i], p.d_z[i] = p.ls_z[i];
      p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = 1;
      p.l_r[i] = p.l_g[i] = p.l_b[i] = 0;
      p.bsdf_pdf[i] = p.ls_pdf[i];  // then the weight is one half
    }
    s.fixture.QueueAll(QueueId::kMiss, kPaths);
    s.fixture.Run(EscapeStage(), s.scene.features);
    std::uint32_t off = 0;  // on a texel's edge
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      const double want = 0.5 * p.ls_r[i] * p.ls_pdf[i];
      off += !(p.l_r[i] == Approx(want).epsilon(1e-4));
    }
    CHECK(off < kPaths / 200);
  }
  ForceTarget("");
}

TEST_CASE("image lights, pictures and portals render as the reference does", "[lights]") {
  SECTION("image lights") {
    CheckStrategies(
        Lit({ImageLight(LightKind::kGoniometric), ImageLight(LightKind::kProjection)}));
  }
  SECTION("pictures") { CheckStrategies(Pictures()); }
  SECTION("a portal of one radiance") { CheckStrategies(Hall()); }
  SECTION("a portal and a map") { CheckStrategies(HallUnderMap()); }
}

TEST_CASE("a picture that is upside down is found", "[lights]") {
  const auto truth = Estimate(
      RenderReference(Pictures(), Options(ReferenceEstimator::kLightSampling, 20000)));
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
  const CompiledScene scene = PrepareScene(description);
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    CAPTURE(target);
    WaveFixture fixture(scene, kPaths);
    fixture.run.features = scene.features;
    PathColumns& p = fixture.wave.path;
    p.light_pmf = nullptr;
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> place(-2, 2), unit(0, 1);
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.p_x[i] = place(engine), p.p_y[i] = place(engine), p.p_z[i] = place(engine);
      p.p_error[i] = 1e-6f;
      p.u_light_0[i] = unit(engine), p.u_light_1[i] = unit(engine);
      p.ls_light[i] = engine() % static_cast<std::uint32_t>(scene.lights.lights.size());
    }
    fixture.QueueAll(QueueId::kLit, kPaths);
    for (const Stage& stage : {SampleTriangleLightStage(), SampleRectangleLightStage(),
                               SampleSphereLightStage(), SampleDiskLightStage()}) {
      fixture.Run(stage, scene.features);
    }
    const std::vector<float> before(p.ls_r, p.ls_r + kPaths);
    fixture.Run(EmissionImageSamplesStage(), scene.features);
    std::uint32_t checked = 0;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      const Vec3d from = Vec3d{p.p_x[i], p.p_y[i], p.p_z[i]} / scene.scale + scene.center;
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
          const double off = std::abs(hits[h].t - p.ls_distance[i] / scene.scale);
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
    CHECK(checked > kPaths / 2);
  }
  ForceTarget("");
}

TEST_CASE("a portal must be a rectangle", "[lights]") {
  SceneDescription hall = Hall();
  CHECK_NOTHROW(PrepareScene(hall));
  hall.lights.back().portal[2].z += 0.1;
  CHECK_THROWS_AS(PrepareScene(hall), InputError);
}

TEST_CASE("scenes without images of lights have nothing of them", "[lights]") {
  const CompiledScene scene = PrepareScene(PolygonLight(8));
  CHECK(scene.lights.images.empty());
  CHECK(scene.lights.texels.empty());
  CHECK(scene.lights.portals.empty());
  CHECK(scene.geometry.uvs.empty());
  for (const PlannedStage& planned : MakePlan(scene, {}).stages) {
    const std::string name = planned.stage.name;
    CHECK(name != "light_image");
    CHECK(name != "light_emission_image");
    CHECK(name != "light_portal");
  }
}

}  // namespace lanelight::test
