// Roulette on shadow rays: single decisions against the definition, the rule for the
// thresholds of pixels, and whole renders.
#include <catch2/catch.hpp>

#include <random>

#include "kernels/stages.h"
#include "src/render/train/training.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/tables.h"
#include "tests/kernels/control/control_scenes.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kRays = 300;

// Rays of random brightness over six decades for pixels of random thresholds.
struct ShadowRays {
  explicit ShadowRays(float floor) : fixture(scene, kRays) {
    PathColumns& p = fixture.wave.path;
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> uniform;
    tables.shadow_threshold.floor = floor;
    for (std::uint32_t i = 0; i < 3 * kRays; ++i) {
      tables.shadow_threshold.inverse.push_back(2 * uniform(engine));
    }
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const float scale = std::pow(10.0f, 6 * uniform(engine) - 4);
      p.pixel[i] = kRays - 1 - i;
      p.sh_r[i] = scale * uniform(engine), p.sh_g[i] = scale * uniform(engine);
      p.sh_b[i] = scale * uniform(engine), p.u_shadow[i] = uniform(engine);
      before.push_back({p.sh_r[i], p.sh_g[i], p.sh_b[i]});
    }
    fixture.run.tables = &tables;
    fixture.wave.rays_shadow = 1000;
    fixture.QueueAll(QueueId::kShadow, kRays);
  }
  // From the definition.
  double Survival(std::uint32_t slot) const {
    const Vec3f v = before[slot];
    const float* inverse = &tables.shadow_threshold.inverse[3 * (kRays - 1 - slot)];
    const double sum =
        std::hypot(double{v.x} * double{inverse[0]}, double{v.y} * double{inverse[1]},
                   double{v.z} * double{inverse[2]});
    return std::min(1.0, std::max(double{tables.shadow_threshold.floor}, sum));
  }

  CompiledScene scene = MakeScene({});
  StrategyTables tables;
  WaveFixture fixture;
  std::vector<Vec3f> before;
};

void CheckDecisions(ShadowRays& rays) {
  const PathColumns& p = rays.fixture.wave.path;
  const Queue& queue = rays.fixture.wave.queue(QueueId::kShadow);
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const double s = rays.Survival(i), u = double{p.u_shadow[i]};
    if (std::abs(u - s) < 1e-5) continue;  // rounding decides
    const bool survives = next < queue.size && queue.items[next] == i;
    CHECK(survives == (u < s));
    if (!survives) continue;
    ++next;
    CHECK(p.sh_r[i] == Approx(double{rays.before[i].x} / s).epsilon(1e-5));
    CHECK(p.sh_g[i] == Approx(double{rays.before[i].y} / s).epsilon(1e-5));
    CHECK(p.sh_b[i] == Approx(double{rays.before[i].z} / s).epsilon(1e-5));
  }
  CHECK(next == queue.size);
  CHECK(rays.fixture.wave.rays_shadow == 1000 - kRays + queue.size);
}

// A room with a weak lamp in a corner and much light from elsewhere.
SceneDescription Room() { return SmallRoom(16, 6, 0.3); }

Rendered RenderRoom(const std::string& strategy, std::uint64_t spp,
                    std::uint64_t seed = 1) {
  TestRender options;
  options.spp = spp;
  options.seed = seed;
  options.strategy = strategy;
  return RenderDescription(Room(), options);
}

}  // namespace

TEST_CASE("shadow rays survive with the defined probability", "[roulette]") {
  const EachTarget target;
  for (float floor : {0.01f, 0.3f}) {
    ShadowRays rays(floor);
    rays.fixture.Run(ShadowRouletteStage, {});
    const std::uint32_t alive = rays.fixture.wave.queue(QueueId::kShadow).size;
    CHECK(alive > kRays / 4);
    CHECK(alive < kRays * 3 / 4);
    CheckDecisions(rays);
  }
}

TEST_CASE("all shadow rays are traced without an image estimate", "[roulette]") {
  ShadowRays rays(0.1f);
  rays.tables.shadow_threshold.inverse.clear();
  rays.fixture.Run(ShadowRouletteStage, {});
  CHECK(rays.fixture.wave.queue(QueueId::kShadow).size == kRays);
  CHECK(rays.fixture.wave.path.sh_g[5] == rays.before[5].y);
}

TEST_CASE("the threshold of shadow rays depends on pixel and cost", "[roulette]") {
  // Two tiles that do not share neighbours: grey 2 and 0.5 in one row of 8x8 tiles.
  std::vector<std::uint32_t> pixels;
  std::vector<Vec3f> colors;
  for (std::uint32_t i = 0; i < 24 * 8; ++i) {
    pixels.push_back(i);
    const float v = i % 24 < 8 ? 2.0f : i % 24 < 16 ? 1.0f : 0.5f;
    colors.push_back({v, v, v});
  }
  const PilotImage image(24, 8, pixels, colors);
  const AlignedVector<float> once = InverseShadowThreshold(image, 24 * 8, 0.5, 1);
  REQUIRE(once.size() == 3 * 24 * 8);
  for (std::uint32_t pixel : {0u, 12u, 23u}) {
    // A ray that carries exactly the threshold of the pixel has probability 1.
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double pixel_threshold = 0.5 / std::sqrt(image.ErrorWeight(pixel, c));
      sum += std::pow(
          pixel_threshold * double{once[3 * pixel + static_cast<unsigned>(c)]}, 2);
    }
    CHECK(sum == Approx(1).epsilon(1e-5));
  }
  CHECK(once[0] < once[3 * 12]);
  CHECK(once[3 * 12] < once[3 * 23]);
  const AlignedVector<float> other = InverseShadowThreshold(image, 24 * 8, 0.25, 3);
  CHECK(other[7] == Approx(6 * once[7]));
  CHECK(InverseShadowThreshold(image, 24 * 8, 0, 1).empty());
  const PilotImage black(24, 8, pixels, std::vector<Vec3f>(24 * 8));
  CHECK(InverseShadowThreshold(black, 24 * 8, 1, 1).empty());
}

TEST_CASE("trained thresholds of shadow rays round-trip", "[roulette]") {
  StrategyTables tables, back;
  CHECK(ExportTraining(tables).size() == 4);
  tables.shadow_threshold.inverse = {0.5f, 3, 1e-7f};
  ImportTraining(ExportTraining(tables), 1, back);
  CHECK(back.shadow_threshold.inverse == tables.shadow_threshold.inverse);
}

TEST_CASE("roulette on shadow rays traces fewer rays without bias", "[roulette]") {
  const Rendered all = RenderRoom("", 4096);
  const Rendered some = RenderRoom("shadow-roulette=contribution", 4096);
  CHECK(some.result.training.samples > 0);
  CHECK(double(some.result.rays_shadow) < 0.95 * double(all.result.rays_shadow));
  CHECK(double(some.result.rays_shadow) > 0.1 * double(all.result.rays_shadow));
  CHECK(some.result.rays_closest == all.result.rays_closest);
  // One false alarm in a million; other paths than those of the image.
  const stat::ImageTestResult result =
      stat::CompareMeans(Estimate(some), Estimate(RenderRoom("", 4096, 2)),
                         {8, 1e-6, kFloatTolerance, 1e-7});
  INFO(result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < 0.02);
}

TEST_CASE("roulette on shadow rays does not depend on threads and wavefront",
          "[roulette]") {
  for (const char* strategy :
       {"shadow-roulette=contribution", "shadow-roulette=contribution:1",
        "shadow-roulette=contribution:0.01,roulette=adjoint"}) {
    CheckDeterminism(Room(), strategy, 32);
  }
}

TEST_CASE("a floor of one traces every shadow ray", "[roulette]") {
  const Rendered all = RenderRoom("", 64);
  const Rendered same = RenderRoom("shadow-roulette=contribution:1", 64);
  CHECK(same.result.rays_shadow == all.result.rays_shadow);
  CHECK(Identical(same.film, all.film));
}

}  // namespace lanelight::test
