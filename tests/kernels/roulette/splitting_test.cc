// Images rendered with roulette and splitting: the same in the mean as without, pure
// functions of scene and seed, and sensible in odd cases.
#include <catch2/catch.hpp>
#include <random>

#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

Rendered RenderSplitting(const SceneDescription& scene, const std::string& strategy,
                         std::uint64_t spp, std::uint64_t seed = 1) {
  TestRender t;
  t.spp = spp;
  t.seed = seed;
  t.strategy = strategy;
  Rendered r = RenderDescription(scene, t);
  CHECK(r.result.health.Total() == 0);
  return r;
}

Material RoughMetal() {
  Material m;
  m.kind = MaterialKind::kConductor;
  m.uroughness.constant = m.vroughness.constant = 0.1;
  m.remap_roughness = false;
  return m;
}

void CheckSameMean(const SceneDescription& scene, const std::string& strategy,
                   std::uint64_t spp, double power) {
  const auto plain = Estimate(RenderSplitting(scene, "roulette=none", spp));
  const auto other = Estimate(RenderSplitting(scene, strategy, spp, 2));
  const auto result = stat::CompareMeans(plain, other, {4, 1e-6, kFloatTolerance, 1e-7});
  INFO(strategy << ": " << result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < power);
  // Power: an error of the size that the test claims to see is seen.
  stat::ImageEstimate wrong = other;
  for (Rgb& v : wrong.mean) v = v * (1 + 2 * result.detectable_bias);
  CHECK_FALSE(stat::CompareMeans(plain, wrong, {4, 1e-6, kFloatTolerance, 1e-7}).same);
}

bool IdenticalImages(const Rendered& a, const Rendered& b) {
  for (int y = 0; y < a.film.height(); ++y) {
    for (int x = 0; x < a.film.width(); ++x) {
      if (!(a.film.Mean(x, y) == b.film.Mean(x, y))) return false;
      if (!(a.film.Variance(x, y) == b.film.Variance(x, y))) return false;
      for (int p = 0; p < kAovPlanes; ++p) {
        if (a.film.Aov(x, y, p) != b.film.Aov(x, y, p)) return false;
      }
    }
  }
  return a.result.roulette == b.result.roulette;
}

// Branching walk in the closed room: k = floor(r + u) copies of weight 1/r each, r
// falling and rising with the depth; without `divide` each keeps its parent's weight.
double BranchingRoom(std::mt19937_64& engine, double weight, double albedo, int depth,
                     bool divide) {
  constexpr double kFactors[] = {1, 2.5, 0.3, 0.7, 0.2, 0.4};
  std::uniform_real_distribution<double> uniform;
  double sum = weight;  // emission of the wall
  const double r = kFactors[std::min(depth, 5)];
  const int copies = static_cast<int>(r + uniform(engine));
  for (int i = 0; i < copies; ++i) {
    sum += BranchingRoom(engine, weight * albedo / (divide ? r : 1), albedo, depth + 1,
                         divide);
  }
  return sum;
}

}  // namespace

TEST_CASE("splitting is unbiased in a room", "[roulette]") {
  CheckSameMean(SmallRoom(12, 5), "roulette=adjoint", 3072, 0.06);
}

TEST_CASE("splitting is unbiased on a glossy plate and with every number paired",
          "[roulette]") {
  CheckSameMean(Plate(RoughMetal()), "roulette=adjoint", 2048, 0.05);
  CheckSameMean(SmallRoom(8, 5), "roulette=adjoint,pairs=antithetic,points=sobol", 4096,
                0.08);
}

TEST_CASE("splitting is unbiased on coats, with independent random walks", "[roulette]") {
  for (const Material& material : MaterialZoo()) {
    if (material.kind != MaterialKind::kCoatedDiffuse) continue;
    CheckSameMean(Plate(material), "roulette=adjoint", 2048, 0.08);
  }
}

TEST_CASE("split paths that keep their parent's weight are rejected", "[roulette]") {
  for (bool divide : {true, false}) {
    std::mt19937_64 engine(5);
    const int n = 1 << 15;
    double sum = 0, squares = 0;
    for (int i = 0; i < n; ++i) {
      const double x = BranchingRoom(engine, 1, 0.5, 0, divide);
      sum += x, squares += x * x;
    }
    const double mean = sum / n, variance = (squares / n - mean * mean) / (n - 1);
    const stat::ImageEstimate image = {1, 1, double(n), {Grey(mean)}, {Grey(variance)}};
    const auto exact = stat::ExpectedImage(1, 1, [](int, int) { return Grey(2); });
    CHECK(stat::CompareMeans(image, exact, {4, 1e-6, 0, 0}).same == divide);
  }
}

TEST_CASE("images with splitting do not depend on threads or wavefronts", "[roulette]") {
  TestRender base;
  base.spp = 160;
  base.threads = 1;
  base.wavefront = 1000;
  base.auxiliary = Auxiliary::kAov;
  base.strategy = "pairs=antithetic,roulette=adjoint";
  const Rendered reference = RenderDescription(SmallRoom(16, 6), base);
  for (const auto& [threads, wavefront] :
       {std::pair{2, 1000u}, {1, 2u}, {2, 64u}, {1, 0u}}) {
    TestRender other = base;
    other.threads = threads;
    other.wavefront = wavefront;
    INFO(threads << " threads, wavefront " << wavefront);
    CHECK(IdenticalImages(RenderDescription(SmallRoom(16, 6), other), reference));
  }
}

TEST_CASE("splitting leaves the auxiliary planes alone", "[roulette]") {
  TestRender t;
  t.spp = 64;
  t.auxiliary = Auxiliary::kAov;
  t.strategy = "roulette=none";
  const Rendered plain = RenderDescription(SmallRoom(16, 4), t);
  t.strategy = "roulette=adjoint";
  const Rendered split = RenderDescription(SmallRoom(16, 4), t);
  for (int p = 0; p < kAovPlanes; ++p) {
    for (int i = 0; i < 16 * 16; ++i) {
      CHECK(split.film.Aov(i % 16, i / 16, p) == plain.film.Aov(i % 16, i / 16, p));
    }
  }
}

TEST_CASE("splitting without light, at little depth, with few samples", "[roulette]") {
  SceneBuilder dark(8, 8);
  dark.Depth(4).Perspective({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40);
  dark.AddPlane({0, 0, 0}, {0, 0, 1}, dark.AddDiffuse(Grey(0.5)));
  const std::string strategy = "roulette=adjoint";
  CHECK(ImageMean(RenderSplitting(dark.Build(), strategy, 16).film) == Rgb{});
  CheckSameMean(SmallRoom(8, 2), strategy, 4096, 0.1);
  for (std::uint64_t spp : {1, 2}) {
    CHECK(ImageMean(RenderSplitting(SmallRoom(8, 3), strategy, spp).film).y > 0);
  }
  // One event: nothing to decide, nothing that splits.
  const Rendered shallow = RenderSplitting(SmallRoom(8, 1), strategy, 16);
  CHECK_FALSE(shallow.plan.features.Has(Feature::kSplitting));
  CHECK(shallow.result.training.samples == 0);
}

TEST_CASE("plans without splitting have no stages for it", "[roulette]") {
  const Rendered plain = RenderSplitting(SmallRoom(8, 4), "roulette=throughput", 4);
  for (Field f : {Field::branch, Field::budget, Field::cell_0, Field::risk_0}) {
    CHECK(std::count(plain.plan.live_fields.begin(), plain.plan.live_fields.end(), f) ==
          0);
  }
  CHECK(plain.plan.slots == plain.plan.wavefront);
  CHECK(plain.result.training.note.empty());
}

}  // namespace lanelight::test
