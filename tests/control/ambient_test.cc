// control=ambient: no variance under an open constant sky however directions are chosen,
// exact irradiance of the projected images, and no bias where things are hidden.
#include <catch2/catch.hpp>

#include "src/core/pi.h"
#include "src/image/exr.h"
#include "src/image/octahedral.h"
#include "src/prepare/ambient.h"
#include "src/prepare/prepared_scene.h"
#include "tests/control/control_scenes.h"
#include "tests/control/quadrature.h"
#include "tests/image/temporary_folder.h"

namespace lanelight::test {
namespace {

constexpr const char* kDirections[] = {"uniform", "bsdf", "light", "mis", "mis:balance"};

// An environment image with a bright spot; `dark`: black texels in the lower half.
SceneDescription WithImage(SceneDescription scene, const std::string& path, bool dark) {
  constexpr int kSize = 8;
  std::vector<ExrPlane> planes = {{"R", {}, true}, {"G", {}, true}, {"B", {}, true}};
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Vec3d d = OctahedralToDirection((x + 0.5) / kSize, (y + 0.5) / kSize);
      const double spot = x == 3 && y == 4 ? 8 : 0;
      const double hidden = dark && d.z < -0.3 ? 0 : 1;
      planes[0].values.push_back(static_cast<float>(hidden * (0.6 + 0.3 * d.x + spot)));
      planes[1].values.push_back(static_cast<float>(hidden * (0.5 + 0.2 * d.y + spot)));
      planes[2].values.push_back(static_cast<float>(hidden * (0.7 + 0.4 * d.z + spot)));
    }
  }
  WriteExr(path, kSize, kSize, planes);
  for (Light& light : scene.lights) {
    if (light.kind == LightKind::kInfinite) light.image_path = path;
  }
  return scene;
}

// The mean of g(d) max(0, n.d) over the sphere, times 4 pi, from the definition.
double HemisphereIntegral(Vec3d n, const std::function<double(Vec3d)>& g) {
  const Vec3d s =
      Normalize(Cross(n, std::abs(n.x) > 0.5 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
  const Vec3d t = Cross(n, s);
  return quadrature::Integrate(0, 1, 2, [&](double z) {
    constexpr int kAngles = 16;
    double sum = 0;
    for (int i = 0; i < kAngles; ++i) {
      const double phi = 2 * kPi * i / kAngles, r = std::sqrt(1 - z * z);
      sum += g(r * std::cos(phi) * s + r * std::sin(phi) * t + z * n);
    }
    return z * sum * 2 * kPi / kAngles;
  });
}

}  // namespace

TEST_CASE("ambient: irradiance is the cosine convolution of the radiance", "[control]") {
  const TemporaryFolder folder;
  SceneDescription scene = Furnace(Lambert(Grey(0.5)), 1);
  scene = WithImage(scene, folder.File("sky.exr"), false);
  Light& light = scene.lights.back();
  light.world_from_light = Transform::Rotate(40, {1, 2, 3});
  const PreparedScene prepared = PrepareScene(scene, {});
  const std::vector<AmbientLight> lights = MakeAmbientLights(prepared);
  REQUIRE(lights.size() == 1);
  const Environment& e = prepared.compiled->lights.environments[0];
  for (Vec3d n : {Vec3d{0, 0, 1}, Normalize(Vec3d{1, -2, 0.5}), Vec3d{-0.6, 0, -0.8}}) {
    for (int c = 0; c < 3; ++c) {
      CHECK(lights[0].irradiance[c](n) ==
            Approx(HemisphereIntegral(n, lights[0].radiance[c])).epsilon(1e-5));
      // Degree 2 holds nearly all of the irradiance of the image itself.
      double sum = 0;
      for (int i = 0; i < e.size * e.size; ++i) {
        const Vec3d w = OctahedralToDirection((i % e.size + 0.5) / e.size,
                                              (i / e.size + 0.5) / e.size);
        const float* m = e.light_from_scene;
        const Vec3d d = {m[0] * w.x + m[3] * w.y + m[6] * w.z,
                         m[1] * w.x + m[4] * w.y + m[7] * w.z,
                         m[2] * w.x + m[5] * w.y + m[8] * w.z};
        sum += double(e.rgb[3 * std::size_t(i) + std::size_t(c)]) *
               std::max(0.0, Dot(n, d)) * 4 * kPi / (e.size * e.size);
      }
      CHECK(lights[0].irradiance[c](n) == Approx(sum).epsilon(0.1));
    }
  }
}

TEST_CASE("ambient: an open constant sky leaves no variance", "[control]") {
  const Rgb albedo = {0.8, 0.5, 0.3}, other = {0.1, 0.4, 0.6};
  for (const char* directions : kDirections) {
    for (bool sheet : {false, true}) {
      SceneBuilder b = PointReceiver(sheet ? Leaf(albedo, other) : Lambert(albedo));
      b.AddEnvironment({2, 3, 4});
      const std::string base = std::string("directions=") + directions;
      const Rendered plain = RenderWith(b.Build(), base, 64);
      const Rendered render = RenderWith(b.Build(), base + ",control=ambient,c=1", 64);
      INFO(directions << (sheet ? ", sheet" : ""));
      CHECK(RelativeDeviation(render) < 1e-4);
      if (std::string(directions) != "bsdf" && base.find("mis") == std::string::npos) {
        CHECK(RelativeDeviation(plain) > 0.05);
      }
      for (int c = 0; c < 3; ++c) {
        const double exact = (albedo[c] + (sheet ? other[c] : 0)) * (2 + c);
        CHECK(ImageMean(render.film)[c] == Approx(exact).epsilon(1e-4));
      }
    }
  }
}

TEST_CASE("ambient: an expectation without its cosine is rejected", "[control]") {
  // Mean of h is albedo L; without the cosine E[h] would be twice that.
  SceneBuilder b = PointReceiver(Lambert(Grey(0.5)));
  b.AddEnvironment(Grey(2));
  const Rendered render =
      RenderWith(b.Build(), "directions=light,control=ambient,c=0.5", 256);
  const auto truth = stat::KnownImage(4, 4, [](int, int) { return Grey(1); });
  stat::ImageEstimate right = Estimate(render), wrong = right;
  for (Rgb& mean : wrong.mean) mean += Grey(0.5 * (2 - 1));
  CHECK(stat::CompareMeans(right, truth).same);
  CHECK_FALSE(stat::CompareMeans(wrong, truth).same);
}

TEST_CASE("ambient: scenes that hide the sky keep their mean", "[control]") {
  const TemporaryFolder folder;
  const SceneDescription constant = Plate(Lambert({0.8, 0.5, 0.2}), 8);
  const SceneDescription sheet = Plate(Leaf({0.4, 0.3, 0.2}, {0.2, 0.3, 0.5}), 8);
  const SceneDescription image = WithImage(constant, folder.File("sky.exr"), false);
  for (const SceneDescription& scene : {constant, sheet, image}) {
    const Rendered plain = RenderWith(scene, "roulette=none", 1024, 5);
    for (const char* directions : kDirections) {
      for (const char* c : {"1", "optimal"}) {
        const std::string strategy =
            std::string("control=ambient,directions=") + directions + ",c=" + c;
        const Rendered render = RenderWith(scene, strategy, 256);
        const stat::ImageTestResult result = Compare(render, plain);
        INFO(strategy << ": " << result.ToString());
        CHECK(result.same);
      }
    }
  }
}

TEST_CASE("ambient: with a tree of lights and roulette at every event", "[control]") {
  const SceneDescription scene = Plate(Lambert({0.8, 0.5, 0.2}), 8);
  const Rendered plain = RenderWith(scene, "", 1024, 5);
  for (const char* base : {"light-selection=tree", "roulette=constant:0.4",
                           "light-selection=uniform,pairs=antithetic"}) {
    const std::string strategy = std::string(base) + ",control=ambient";
    const stat::ImageTestResult result = Compare(RenderWith(scene, strategy, 256), plain);
    INFO(strategy << ": " << result.ToString());
    CHECK(result.same);
  }
}

TEST_CASE("ambient: uniform directions gain what theory says", "[control]") {
  // f = h: all of the variance 1/3 of the squared mean goes.
  const SceneDescription scene = Furnace(Lambert(Grey(0.5)), 1);
  const Rendered plain = RenderWith(scene, "directions=uniform", 256);
  CHECK(RelativeDeviation(plain) == Approx(std::sqrt(1.0 / 3)).epsilon(0.05));
  const Rendered fitted = RenderWith(scene, "directions=uniform,control=ambient", 256);
  CHECK(RelativeDeviation(fitted) < 0.01);
  REQUIRE(fitted.result.control.has_value());
  CHECK(fitted.result.control->correlation > 0.999);
  CHECK(fitted.result.control->coefficient == Approx(1).epsilon(0.01));
}

TEST_CASE("ambient: images that light samples do not find all of", "[control]") {
  const TemporaryFolder folder;
  const SceneDescription dark =
      WithImage(Furnace(Lambert(Grey(0.5)), 1), folder.File("dark.exr"), true);
  CHECK_THROWS_WITH(RenderWith(dark, "directions=light,control=ambient", 4),
                    Catch::Contains("black") && Catch::Contains("directions=mis"));
  const Rendered plain = RenderWith(dark, "", 512, 2);
  const Rendered render = RenderWith(dark, "control=ambient,c=1", 512);
  const stat::ImageTestResult result = Compare(render, plain);
  INFO(result.ToString());
  CHECK(result.same);
  // A constant sky besides it can be sampled everywhere: the image takes no part.
  SceneDescription both = dark;
  both.lights.push_back(both.lights.back());
  both.lights.back().image_path.clear();
  const Rendered sum = RenderWith(both, "directions=light,control=ambient,c=1", 512);
  const stat::ImageTestResult mixed =
      Compare(sum, RenderWith(both, "directions=light", 512, 2));
  INFO(mixed.ToString());
  CHECK(mixed.same);
}

TEST_CASE("ambient: images do not depend on threads and wavefront", "[control]") {
  CheckDeterminism(Plate(Lambert(Grey(0.7)), 16), "control=ambient", 32);
}

}  // namespace lanelight::test
