// control=analytic in renders: no variance where nothing shadows, no bias anywhere.
#include <catch2/catch.hpp>

#include "src/core/pi.h"
#include "tests/control/control_scenes.h"
#include "tests/control/quadrature.h"

namespace lanelight::test {
namespace {

const Rgb kAlbedo = {0.8, 0.5, 0.3};

// A light, and its irradiance on the origin with normal +z and -z.
struct LitPoint {
  const char* name;
  std::function<void(SceneBuilder&, Index black)> add;
  double above, below;
};

double Quad(Vec3d corner, Vec3d e1, Vec3d e2, Vec3d n) {
  const Vec3d a[3] = {corner, corner + e1, corner + e1 + e2};
  const Vec3d b[3] = {corner, corner + e1 + e2, corner + e2};
  return quadrature::Triangle(a, n) + quadrature::Triangle(b, n);
}

std::vector<LitPoint> Lights() {
  const Vec3d up = {0, 0, 1}, down = {0, 0, -1};
  const auto quad = [=](const char* name, Vec3d corner, Vec3d e1, Vec3d e2) {
    return LitPoint{name,
                    [=](SceneBuilder& b, Index black) {
                      b.AddQuad(corner, e1, e2, black, b.AddEmission(Grey(2)));
                    },
                    2 * Quad(corner, e1, e2, up), 2 * Quad(corner, e1, e2, down)};
  };
  const auto sphere = [=](const char* name, Vec3d center, double radius) {
    return LitPoint{name,
                    [=](SceneBuilder& b, Index black) {
                      b.AddSphere(center, radius, black, b.AddEmission(Grey(2)));
                    },
                    2 * quadrature::Sphere(center, radius, up),
                    2 * quadrature::Sphere(center, radius, down)};
  };
  const Vec3d center = {0.6, -0.7, 1.1}, axis = Normalize(Vec3d{-0.5, 0.3, -1});
  return {quad("quad", {-1.4, 0.2, 1}, {0, 0.8, 0.3}, {1.2, 0, 0}),
          quad("quad across the horizon", {1, -0.5, -0.4}, {0.1, 0, 1.3}, {0, 1, 0.1}),
          sphere("sphere", {0.5, 0.7, 1}, 0.3),
          sphere("sphere across the horizon", {1, 0.4, 0.1}, 0.4),
          {"disk",
           [=](SceneBuilder& b, Index black) {
             b.AddDisk(center, axis, 0.4, black, b.AddEmission(Grey(2)));
           },
           2 * quadrature::Disk(center, axis, 0, 0.4, up), 0}};
}

Index Black(SceneBuilder& b) { return b.AddDiffuse(Grey(0)); }

void CheckNoVariance(const SceneDescription& scene, const std::string& strategy,
                     Rgb exact) {
  INFO(strategy);
  const Rendered plain = RenderWith(scene, strategy, 64);
  const Rendered render = RenderWith(scene, strategy + ",control=analytic,c=1", 64);
  CHECK(RelativeDeviation(render) < 1e-4);
  CHECK(RelativeDeviation(plain) > 0.03);
  for (int c = 0; c < 3; ++c) {
    CHECK(ImageMean(render.film)[c] == Approx(exact[c]).epsilon(1e-4).margin(1e-7));
  }
}

}  // namespace

TEST_CASE("analytic: unoccluded receivers have no variance left", "[control]") {
  for (const LitPoint& light : Lights()) {
    INFO(light.name);
    SceneBuilder b = PointReceiver(Lambert(kAlbedo));
    light.add(b, Black(b));
    CheckNoVariance(b.Build(), "directions=light", kAlbedo * (light.above / kPi));
  }
}

TEST_CASE("analytic: several lights, chosen in any way", "[control]") {
  SceneBuilder b = PointReceiver(Lambert(kAlbedo));
  double above = 0;
  for (const LitPoint& light : Lights()) {
    if (std::string(light.name).find("across") != std::string::npos) continue;
    light.add(b, Black(b));
    above += light.above;
  }
  for (const char* selection : {"uniform", "power", "tree"}) {
    CheckNoVariance(b.Build(),
                    std::string("directions=light,light-selection=") + selection,
                    kAlbedo * (above / kPi));
  }
}

TEST_CASE("analytic: both sides of a sheet", "[control]") {
  const Rgb other = {0.1, 0.3, 0.5};
  SceneBuilder b = PointReceiver(Leaf(kAlbedo, other));
  const Index black = Black(b);
  b.AddSphere({0.5, 0.4, 1}, 0.3, black, b.AddEmission(Grey(2)));
  b.AddQuad({0.6, -0.2, -1}, {0.5, 0, 0}, {0, 0.6, 0}, black, b.AddEmission(Grey(3)));
  const double above = 2 * quadrature::Sphere({0.5, 0.4, 1}, 0.3, {0, 0, 1});
  const double below = 3 * Quad({0.6, -0.2, -1}, {0.5, 0, 0}, {0, 0.6, 0}, {0, 0, -1});
  CheckNoVariance(b.Build(), "directions=light",
                  (kAlbedo * above + other * below) * (1 / kPi));
}

TEST_CASE("analytic: shadowed rooms keep their mean", "[control]") {
  for (const SceneDescription& scene :
       {SmallRoom(8, 2, 0.8), Plate(Lambert({0.8, 0.5, 0.2}), 8),
        Plate(Leaf({0.4, 0.3, 0.2}, {0.2, 0.3, 0.5}), 8)}) {
    const Rendered plain = RenderWith(scene, "", 4096, 7);
    for (const char* directions : {"mis", "light"}) {
      for (const char* c : {"1", "0.5", "optimal"}) {
        const std::string strategy =
            std::string("control=analytic,directions=") + directions + ",c=" + c;
        const Rendered render = RenderWith(scene, strategy, 1024);
        const stat::ImageTestResult result = Compare(render, plain);
        INFO(strategy << ": " << result.ToString());
        CHECK(result.same);
        CHECK(result.detectable_bias < (directions[0] == 'm' ? 0.08 : 0.15));
      }
    }
  }
}

TEST_CASE("analytic: the fitted coefficient does not lose", "[control]") {
  // A ball hides about a third of the light.
  SceneBuilder b = PointReceiver(Lambert(kAlbedo), 8);
  const Index black = Black(b);
  b.AddQuad({-0.5, -0.5, 1}, {0, 1, 0}, {1, 0, 0}, black, b.AddEmission(Grey(2)));
  b.AddSphere({0.3, 0.1, 0.6}, 0.15, black);
  for (const char* directions : {"light", "mis"}) {
    const std::string base = std::string("directions=") + directions;
    const auto variance = [&](const char* c) {
      return MeanVariance(RenderWith(b.Build(), base + ",control=analytic,c=" + c, 512));
    };
    const Rendered render = RenderWith(b.Build(), base + ",control=analytic", 512);
    const double fitted = MeanVariance(render);
    INFO(directions << " fitted " << fitted << ", 0 " << variance("0") << ", 1 "
                    << variance("1"));
    REQUIRE(render.result.control.has_value());
    const ControlReport& report = *render.result.control;
    INFO("coefficient " << report.coefficient << ", r " << report.correlation);
    CHECK(fitted < 1.02 * variance("1"));
    // What theory says: 1 - r^2 of the variance stays.
    CHECK(fitted == Approx((1 - report.correlation * report.correlation) * variance("0"))
                        .epsilon(0.05));
    CHECK(report.correlation > 0.3);
  }
}

TEST_CASE("analytic: an expectation without its cosine is rejected", "[control]") {
  // E[h] with the solid angle of the light in place of the projected one.
  const SceneDescription scene = PolygonLight(8);
  const std::vector<Vec3d> c = PolygonCorners();
  const Rendered render = RenderWith(scene, "control=analytic,c=1", 64);
  stat::ImageEstimate right = Estimate(render), wrong = right;
  stat::ImageEstimate exact = stat::KnownImage(8, 8, [](int, int) { return Rgb(); });
  for (int i = 0; i < 64; ++i) {
    const auto at = static_cast<std::size_t>(i);
    constexpr int kSub = 4;
    double irradiance = 0, solid_angle = 0;
    for (int k = 0; k < kSub * kSub; ++k) {
      const Vec3d p =
          FilmPoint(i % 8 + (k % kSub + 0.5) / kSub, i / 8 + (k / kSub + 0.5) / kSub, 8);
      const Vec3d corner = c[0] - p, e1 = c[1] - c[0], e2 = c[3] - c[0];
      irradiance += Quad(corner, e1, e2, {0, 0, 1}) / (kSub * kSub);
      const Vec3d middle = Normalize(corner + 0.5 * e1 + 0.5 * e2);
      solid_angle += Quad(corner, e1, e2, middle) / (kSub * kSub);
    }
    exact.mean[at] = Grey(3 * 0.5 / kPi * irradiance);
    wrong.mean[at] += Grey(3 * 0.5 / kPi * (solid_angle - irradiance));
  }
  const stat::ImageTestOptions options = {4, 1e-6, 3e-4, 1e-6};
  CHECK(stat::CompareMeans(right, exact, options).same);
  CHECK_FALSE(stat::CompareMeans(wrong, exact, options).same);
}

TEST_CASE("analytic: images do not depend on threads and wavefront", "[control]") {
  CheckDeterminism(SmallRoom(16), "control=analytic,points=sobol", 40);
}

}  // namespace lanelight::test
