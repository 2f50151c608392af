// The phase function: values against the scalar form, samples against the values.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "src/base/stat/hypothesis.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/shade/probe_batch.h"
#include "tests/reference/media.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

constexpr double kAsymmetries[] = {-0.95, -0.4, 0, 1e-4, 0.3, 0.8, 0.99};
constexpr int kCosines = 24, kTurns = 8;
constexpr std::uint32_t kSamples = 1 << 15;

TestMaterial Phase(double g) {
  reference::LocalMaterial local;
  local.index = g;
  return MakeTestMaterial("phase", ShadeKind::kHenyeyGreenstein, local);
}

// Probability of turning by an angle with a cosine of at most c (the integral of the
// density, from -1).
double Distribution(double g, double c) {
  if (std::abs(g) < 1e-6) return (1 + c) / 2;
  return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * c) - 1 / (1 + g));
}

// Cells of equal probability in the cosine, so that narrow lobes are seen as well.
int Cell(double g, Vec3d wo, Vec3d wi) {
  const double fraction = Distribution(g, -Dot(wo, wi)) * kCosines;
  const double turn = std::atan2(wi.y, wi.x) / (2 * std::numbers::pi) + 0.5;
  const int row = std::clamp(static_cast<int>(fraction), 0, kCosines - 1);
  const int column = std::clamp(static_cast<int>(turn * kTurns), 0, kTurns - 1);
  return row * kTurns + column;
}

double PValue(double sampled_g, double g) {
  ProbeBatch batch(kSamples);
  const Vec3d wo = {0, 0, 1};
  batch.SetWo(wo);
  batch.RandomPoints(7);
  batch.Sample(Phase(sampled_g));
  std::vector<double> counts(kCosines * kTurns, 0);
  for (std::uint32_t i = 0; i < kSamples; ++i) counts[Cell(g, wo, batch.Wi(i))] += 1;
  const std::vector<double> expected(
      counts.size(), double{kSamples} / static_cast<double>(counts.size()));
  return stat::ChiSquareTest(counts, expected).p;
}

}  // namespace

TEST_CASE("phase function: samples have its density", "[media][stat]") {
  const int tests = static_cast<int>(std::size(kAsymmetries) * AvailableTargets().size());
  const double level = stat::SidakLevel(1e-3, tests);
  const EachTarget target;
  for (const double g : kAsymmetries) {
    INFO("g = " << g);
    CHECK(PValue(g, g) > level);
  }
  CHECK(PValue(0.35, 0.3) < 1e-6);  // another one is rejected
}

TEST_CASE("phase function: values and densities", "[media]") {
  reference::Random random(3);
  const EachTarget target;
  for (const double g : kAsymmetries) {
    const float stored = static_cast<float>(g);
    ProbeBatch batch(256);
    batch.SetWo({0, 0, 1});
    for (std::uint32_t i = 0; i < batch.n; ++i) {
      batch.SetWi(i, reference::SamplePhaseFunction(g, {0, 0, -1}, random));
    }
    batch.Eval(Phase(g));
    double worst = 0;
    for (std::uint32_t i = 0; i < batch.n; ++i) {
      // Directions are rounded: the cosine by their distance from one another.
      const Vec3d apart = batch.Wi(i) + (g < 0 ? -1.0 : 1.0) * batch.Wo(i);
      const double expected =
          reference::PhaseFunction(std::abs(stored), 1 - Dot(apart, apart) / 2);
      worst = std::max(worst, std::abs(batch.pdf[i] / expected - 1));
      CHECK(batch.value[0][i] == batch.pdf[i]);
    }
    INFO("g = " << g);
    CHECK(worst < 3e-5);
  }
}

TEST_CASE("phase function: extreme random numbers", "[media]") {
  for (const double g : {-0.9999, -0.999, 0.999, 0.9999}) {
    ProbeBatch batch(4);
    batch.SetWo({0, 0, 1});
    const float last = 1 - 0x1p-24f;
    batch.u[1] = {0, last, 0, last, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    batch.u[2] = {0, 0, last, last, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    batch.Sample(Phase(g));
    for (std::uint32_t i = 0; i < 4; ++i) {
      CHECK(Length(batch.Wi(i)) == Approx(1).margin(1e-5));
      CHECK(batch.value[0][i] == 1);
      CHECK(std::isfinite(batch.pdf[i]));
      CHECK(batch.pdf[i] > 0);
    }
  }
}

}  // namespace lanelight::test
