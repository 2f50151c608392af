// pairs=antithetic: adjacent slots, reflected numbers, and the variance that theory says.
#include <catch2/catch.hpp>

#include "kernels/stages.h"
#include "src/base/stat/distributions.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/agreement/agreement.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

// A diffuse body that fills the image under a uniform sky: with uniform directions one
// bounce returns 2 albedo (1 - u0), linear in the number u_bsdf_0 and in no other.
SceneDescription LinearScene(double albedo) {
  Material m;
  m.reflectance.constant = Grey(albedo);
  return Furnace(m, 1);
}

Rendered RenderPairs(const SceneDescription& scene, const std::string& strategy,
                     std::uint64_t spp, std::uint64_t seed = 1) {
  TestRender options;
  options.spp = spp;
  options.seed = seed;
  options.strategy = strategy;
  return RenderDescription(scene, options);
}

// Mean over the pixels of the variance of one sample.
double SampleVariance(const Rendered& render) {
  const FilmAccumulator& film = render.film;
  double sum = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      sum += film.Variance(x, y).y * static_cast<double>(film.Samples(x, y));
    }
  }
  return sum / (film.width() * film.height());
}

}  // namespace

TEST_CASE("antithetic: variance is zero where the integrand is linear", "[strategy]") {
  const double albedo = 0.6;
  const SceneDescription scene = LinearScene(albedo);
  const std::string uniform = "directions=uniform";
  // 2 a (1 - u): variance 4 a^2 / 12.
  const double plain = SampleVariance(RenderPairs(scene, uniform, 4096));
  CHECK(plain == Approx(albedo * albedo / 3).epsilon(0.03));
  const Rendered pairs = RenderPairs(scene, uniform + ",pairs=antithetic", 4096);
  CHECK(SampleVariance(pairs) < 1e-10);
  CHECK(pairs.film.Mean(3, 3).y == Approx(albedo).epsilon(1e-6));
}

TEST_CASE("antithetic: quadratic integrands lose or gain as theory says", "[strategy]") {
  // In-sphere scattering sampled uniformly: f = 2 pi a 2 z^3 / pi = 4 a z^3 with z
  // uniform. Var f = 16 a^2 (1/7 - 1/16); E[f f'] = 16 a^2 int z^3 (1-z)^3 = 16 a^2 /
  // 140. A pair's mean has variance (Var f + Cov) / 2, so per sample Var f + Cov.
  Material m;
  m.reflectance.constant = Grey(0.5);
  m.scattering = Scattering::kInSphere;
  const SceneDescription scene = Furnace(m, 1);
  const double variance = 4 * (1.0 / 7 - 1.0 / 16);
  const double covariance = 4 * (1.0 / 140 - 1.0 / 16);
  const double plain = SampleVariance(RenderPairs(scene, "directions=uniform", 16384));
  const double pairs =
      SampleVariance(RenderPairs(scene, "directions=uniform,pairs=antithetic", 16384));
  CHECK(plain == Approx(variance).epsilon(0.03));
  CHECK(pairs == Approx(variance + covariance).epsilon(0.03));
}

TEST_CASE("antithetic: the second sample has the first one's numbers, reflected",
          "[strategy]") {
  const PreparedScene scene = PrepareScene(LinearScene(0.5));
  WaveFixture f(scene.Parts(), 64);
  f.wave.path.branch = nullptr;
  f.run.pairs = true;
  f.run.sampler = MakeSamplerParameters(SampleSequence::kIndependent);
  const std::uint32_t pixels[3] = {7, 8, 9};
  f.wave.work.pixels = pixels;
  f.wave.work.num_pixels = 3;
  f.wave.work.first_sample = 4;
  f.wave.work.samples = 5;  // odd: the last one has no partner
  f.wave.work.together = 2;
  Queue& free = f.wave.queue(QueueId::kFree);
  free.size = 64;
  for (std::uint32_t i = 0; i < 64; ++i) free.items[i] = 63 - i;
  f.Run(GenerateStage, {});
  const Queue& camera = f.wave.queue(QueueId::kCamera);
  REQUIRE(camera.size == 15);
  f.Run(IndependentCameraStage, {});
  f.Run(AntitheticCameraStage, {});
  const PathColumns& p = f.wave.path;
  for (std::uint32_t i = 0; i + 1 < 12; i += 2) {
    const std::uint32_t a = camera.items[i], b = camera.items[i + 1];
    CHECK(p.pixel[a] == p.pixel[b]);
    CHECK(p.sample[a] + 1 == p.sample[b]);
    CHECK(p.sample[a] % 2 == 0);
    CHECK(p.u_film_0[b] == 1 - 0x1p-24f - p.u_film_0[a]);
    CHECK(p.u_film_1[b] == 1 - 0x1p-24f - p.u_film_1[a]);
  }
  f.QueueAll(QueueId::kSurface, 15);
  f.Run(IndependentBounceStage, {});
  f.Run(AntitheticBounceStage, {});
  for (std::uint32_t i = 0; i + 1 < 12; i += 2) {
    const std::uint32_t a = camera.items[i], b = camera.items[i + 1];
    CHECK(p.u_bsdf_0[b] == 1 - 0x1p-24f - p.u_bsdf_0[a]);
    CHECK(std::abs(p.u_bsdf_1[b] - p.u_bsdf_1[a]) == 0.5f);
    CHECK(p.u_light_0[b] == 1 - 0x1p-24f - p.u_light_0[a]);
    CHECK(p.u_roulette[b] == 1 - 0x1p-24f - p.u_roulette[a]);
  }
}

TEST_CASE("antithetic: odd numbers of samples, and any wavefront, give the same image",
          "[strategy]") {
  const SceneDescription scene = SmallRoom(12, 3);
  for (std::uint64_t spp : {1u, 7u, 33u}) {
    TestRender options;
    options.spp = spp;
    options.strategy = "pairs=antithetic,points=sobol";
    const Rendered first = RenderDescription(scene, options);
    options.wavefront = spp == 7 ? 1 : 64;  // a pair needs two slots, and gets them
    options.threads = 1;
    const Rendered second = RenderDescription(scene, options);
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x) {
        CHECK(first.film.Samples(x, y) == spp);
        CHECK(first.film.Mean(x, y) == second.film.Mean(x, y));
      }
    }
  }
}

}  // namespace lanelight::test
