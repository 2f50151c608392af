// Orders of convergence of whole renders of smooth integrands: an unoccluded diffuse
// plane under an area light, lit by light samples, and under a constant environment,
// sampled uniformly. The view is a point, so that the position in the pixel adds nothing;
// all pixels are observations of one closed form.
#include <catch2/catch.hpp>

#include "tests/kernels/samplers/slope.h"
#include "tests/reference/closed_forms.h"
#include "tests/reference/scenes.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight::test {
namespace {

constexpr int kSize = 8;
constexpr std::uint64_t kSeeds = 8;
constexpr double kAlbedo = 0.5;

struct Convergence {
  const char* directions;
  SceneDescription scene;
  double exact;
};

SceneBuilder Floor() {
  SceneBuilder b(kSize, kSize);
  b.Depth(1).Orthographic({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1e-6);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(kAlbedo)));
  return b;
}

// One triangle: the choice between the two of a quad would be a third dimension with a
// jump, in which points that are stratified in pairs of dimensions gain nothing.
Convergence AreaLight() {
  SceneBuilder b = Floor();
  const std::vector<Vec3d> c = {{-0.5, -0.25, 1.5}, {-0.5, 0.75, 2}, {1, 0.75, 2}};
  TriangleMesh mesh;
  mesh.positions = c;
  mesh.indices = {0, 1, 2};
  b.AddMesh(mesh, b.AddDiffuse(Grey(0)), b.AddEmission(Grey(3), true));
  return {"light", b.Build(),
          kAlbedo / std::numbers::pi *
              closed_form::PolygonIrradiance(3, c, {0, 0, 0}, {0, 0, 1})};
}

Convergence Environment() {
  SceneBuilder b = Floor();
  b.AddEnvironment(Grey(2));
  return {"uniform", b.Build(), kAlbedo * 2};
}

// Root mean square error of green over the pixels of images of several seeds.
double Rmse(const Convergence& c, SampleSequence sampler, std::uint64_t spp) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    TestRender options;
    options.spp = spp;
    options.seed = seed;
    options.sampler = sampler;
    options.strategy = fmt::format("directions={},roulette=none", c.directions);
    const Rendered image = RenderDescription(c.scene, options);
    REQUIRE(image.result.health.Total() == 0);
    for (int i = 0; i < kSize * kSize; ++i) {
      const double error = image.film.Mean(i % kSize, i / kSize).y - c.exact;
      sum += error * error;
    }
  }
  return std::sqrt(sum / (kSize * kSize * kSeeds));
}

// From 4 to 1024 samples per pixel. Groups are a quarter of them, four per pixel, so the
// order is that of the groups.
double Slope(const Convergence& c, SampleSequence sampler) {
  std::vector<double> n, rmse;
  for (std::uint64_t spp = 4; spp <= 1024; spp *= 4) {
    n.push_back(double(spp));
    rmse.push_back(Rmse(c, sampler, spp));
  }
  return LogSlope(n, rmse);
}

}  // namespace

// 512 observations give each RMSE within 3 %, five of them a slope within 0.007.
TEST_CASE("wavefront: orders of convergence of smooth integrands", "[convergence]") {
  for (const Convergence& c : {AreaLight(), Environment()}) {
    INFO(c.directions);
    CHECK(Slope(c, SampleSequence::kIndependent) == Approx(-0.5).margin(0.05));
    CHECK(Slope(c, SampleSequence::kStratified) <= -0.70);
    CHECK(Slope(c, SampleSequence::kSobol) <= -0.90);
    CHECK(Slope(c, SampleSequence::kHalton) <= -0.70);
  }
}

}  // namespace lanelight::test
