// Coats whose medium scatters, against what must be true of them: nothing is lost where
// nothing absorbs, light may go either way, and without an albedo they are clear coats.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "src/base/stat/hypothesis.h"
#include "tests/kernels/shade/probe_batch.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kCount = 1 << 15;
constexpr Rgb kWhole = {1, 1, 1};

TestMaterial Haze(double alpha, double thickness, double g, Rgb albedo, Rgb base,
                  int depth = 10) {
  reference::LocalMaterial m;
  m.kind = MaterialKind::kCoatedDiffuse;
  m.reflectance = base;
  m.interface = {alpha, alpha};
  m.thickness = thickness;
  m.albedo = albedo;
  m.g = g;
  m.coat_max_depth = depth;
  return MakeTestMaterial("haze", ShadeKind::kCoatedDiffuseMedium, m);
}

struct MeanOf {
  double n = 0, sum = 0, squares = 0;
  void Add(double v) { n += 1, sum += v, squares += v * v; }
  stat::MeanEstimate Estimate() const {
    const double mean = sum / n;
    return {mean, std::max(0., squares / n - mean * mean) / (n - 1), n - 1};
  }
};

// What uniform light leaves as towards wo: of samples, and of values at uniform
// directions.
MeanOf SampledEnergy(const TestMaterial& m, Vec3d wo, std::uint32_t count = kCount) {
  ProbeBatch batch(count);
  batch.SetWo(wo);
  batch.RandomPoints(91);
  batch.Sample(m, 92);
  MeanOf mean;
  for (std::uint32_t i = 0; i < batch.n; ++i) mean.Add(batch.Value(i).x);
  return mean;
}
MeanOf EvaluatedEnergy(const TestMaterial& m, Vec3d wo) {
  ProbeBatch batch(kCount);
  batch.SetWo(wo);
  reference::Random random(93);
  for (std::uint32_t i = 0; i < batch.n; ++i) {
    Vec3d wi = RandomDirection(random);
    wi.z = std::copysign(wi.z, wo.z);
    batch.SetWi(i, wi);
  }
  batch.Eval(m, 94);
  MeanOf mean;
  for (std::uint32_t i = 0; i < batch.n; ++i) {
    mean.Add(2 * std::numbers::pi * batch.Value(i).x);
  }
  return mean;
}

double Mirrored(double cosine, double index) {
  return reference::FresnelDielectric(cosine, index);
}

// Estimates of f(wo, wi) |cos wi| for one pair of directions.
MeanOf ValueOf(const TestMaterial& m, Vec3d wo, Vec3d wi, std::uint32_t seed) {
  ProbeBatch batch(kCount);
  batch.SetWo(wo);
  for (std::uint32_t i = 0; i < batch.n; ++i) batch.SetWi(i, wi);
  batch.Eval(m, seed);
  MeanOf mean;
  for (std::uint32_t i = 0; i < batch.n; ++i) mean.Add(batch.Value(i).x);
  return mean;
}

}  // namespace

TEST_CASE("a white coat over a white base loses nothing", "[shade][stat]") {
  for (double thickness : {0.1, 2.0}) {
    for (double g : {-0.5, 0.0, 0.8}) {
      const TestMaterial m = Haze(0, thickness, g, kWhole, kWhole, 10000);
      for (Vec3d wo : {TestDirections()[1], TestDirections()[3]}) {
        INFO("thickness " << thickness << ", g " << g << ", wo.z " << wo.z);
        // Each walk leaves with all that it came with.
        CHECK(SampledEnergy(m, wo, kCount / 8).Estimate().mean == Approx(1).margin(1e-4));
        const double rest = 1 - Mirrored(std::abs(wo.z), 1.5);
        const auto seen = EvaluatedEnergy(m, wo).Estimate();
        CHECK(stat::WelchPValue(seen, {rest, 0, 0}) > stat::SidakLevel(1e-6, 12));
        CHECK(std::sqrt(seen.variance) < 0.02);
      }
    }
  }
}

TEST_CASE("random walks in coats end at their max depth", "[shade]") {
  // One event is the exit, which no path reaches without another one.
  const TestMaterial one = Haze(0, 0.5, 0, kWhole, kWhole, 1);
  const double r = Mirrored(0.7, 1.5);
  const Vec3d wo = {std::sqrt(1 - 0.49), 0, 0.7};
  CHECK(SampledEnergy(one, wo).Estimate().mean == Approx(r).margin(0.01));
  CHECK(EvaluatedEnergy(one, wo).sum == 0);
  CHECK(EvaluatedEnergy(Haze(0, 0.5, 0, kWhole, kWhole, 2), wo).sum > 0);
}

TEST_CASE("a medium without albedo is a clear coat", "[shade][stat]") {
  for (double alpha : {0.0, 0.3}) {
    const Rgb base = {0.8, 0.5, 0.2};
    TestMaterial hazy = Haze(alpha, 0.4, 0, {}, base);
    const ShadeKind kind =
        alpha == 0 ? ShadeKind::kCoatedDiffuseSmooth : ShadeKind::kCoatedDiffuseRough;
    const TestMaterial clear = MakeTestMaterial("clear", kind, hazy.local);
    for (Vec3d wo : TestDirections()) {
      const auto a = SampledEnergy(hazy, wo).Estimate();
      const auto b = SampledEnergy(clear, wo).Estimate();
      const auto c = EvaluatedEnergy(hazy, wo).Estimate();
      const auto d = EvaluatedEnergy(clear, wo).Estimate();
      INFO("alpha " << alpha << ", wo.z " << wo.z << ": " << a.mean << " " << b.mean
                    << ", " << c.mean << " " << d.mean);
      // The clear one is tabulated.
      CHECK(stat::WelchPValue(a, b, 3e-3) > stat::SidakLevel(1e-6, 16));
      CHECK(stat::WelchPValue(c, d, 3e-3) > stat::SidakLevel(1e-6, 16));
    }
  }
}

TEST_CASE("a scattering coat transmits in both directions", "[shade][stat]") {
  const Vec3d a = TestDirections()[0], b = TestDirections()[2];
  const TestMaterial list[] = {Haze(0, 0.7, 0.5, kWhole * 0.9, kWhole * 0.5, 200),
                               Haze(0.3, 0.7, -0.5, kWhole * 0.9, kWhole * 0.5, 200)};
  for (const TestMaterial& m : list) {
    auto there = ValueOf(m, a, b, 95).Estimate(), back = ValueOf(m, b, a, 96).Estimate();
    there.mean /= b.z, there.variance /= b.z * b.z;
    back.mean /= a.z, back.variance /= a.z * a.z;
    INFO("alpha " << m.local.interface.ax << ": " << there.mean << " " << back.mean);
    CHECK(stat::WelchPValue(there, back) > stat::SidakLevel(1e-6, 2));
    CHECK(std::sqrt(there.variance + back.variance) < 0.02 * back.mean);
  }
}

}  // namespace lanelight::test
