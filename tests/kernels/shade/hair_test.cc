// Hair by itself: energy, and where its lobes lie.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/kernels/shade/probe_batch.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

TestMaterial HairOf(double beta_m, double beta_n, double tilt, double h, double colour) {
  reference::LocalMaterial m;
  m.kind = MaterialKind::kHair;
  m.index = 1.55;
  m.h = h;
  m.reflectance = Rgb{colour, colour, colour};
  m.interface = {beta_m, beta_n};
  m.metal = {tilt, 0};
  return MakeTestMaterial("hair", ShadeKind::kHair, m);
}

// What of light from everywhere comes to wo, over equal areas of directions.
double Furnace(const TestMaterial& m, Vec3d wo) {
  constexpr int kRows = 512, kColumns = 512;
  ProbeBatch batch(kRows * kColumns);
  batch.SetWo(wo);
  for (int i = 0; i < kRows * kColumns; ++i) {
    const double x = (i / kColumns + 0.5) * 2 / kRows - 1, r = std::sqrt(1 - x * x);
    const double phi = 2 * std::numbers::pi * (i % kColumns + 0.5) / kColumns;
    batch.SetWi(i, {x, r * std::cos(phi), r * std::sin(phi)});
  }
  batch.Eval(m);
  double sum = 0;
  for (std::uint32_t i = 0; i < batch.n; ++i) sum += batch.value[1][i];
  return sum * 4 * std::numbers::pi / batch.n;
}

// The direction of the brightest sample, and how bright.
struct Peak {
  Vec3d at;
  double value = 0;
};
Peak BrightestAround(const TestMaterial& m, Vec3d wo) {
  constexpr std::uint32_t kCount = 4096;
  ProbeBatch batch(kCount);
  batch.SetWo(wo);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double phi = 2 * std::numbers::pi * i / kCount;
    batch.SetWi(i, {0, std::cos(phi), std::sin(phi)});
  }
  batch.Eval(m);
  Peak peak;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    if (batch.value[1][i] > peak.value) peak = {batch.Wi(i), batch.value[1][i]};
  }
  return peak;
}

}  // namespace

TEST_CASE("hair without absorption conserves energy", "[shade][hair]") {
  const EachTarget target;
  for (const double beta_m : {0.15, 0.3, 0.6, 1.0}) {
    for (const double beta_n : {0.15, 0.3, 0.6, 1.0}) {
      if (target.name() == "EMU128" && beta_m != beta_n) continue;
      for (const double h : {-0.9, 0.0, 0.5}) {
        const double x = 0.4 * h + 0.1;
        const Vec3d wo = {x, -0.6 * std::sqrt(1 - x * x), 0.8 * std::sqrt(1 - x * x)};
        INFO(beta_m << ", " << beta_n << ", " << h);
        CHECK(Furnace(HairOf(beta_m, beta_n, 0.03, h, 1), wo) == Approx(1).margin(2e-3));
        CHECK(Furnace(HairOf(beta_m, beta_n, 0.03, h, 0.02), wo) < 0.9);
      }
    }
  }
}

// Black hair does nothing but reflect: at its surface, at the place that h says.
TEST_CASE("hair reflects about the normal at the hit", "[shade][hair]") {
  for (const double h : {-0.7, -0.2, 0.0, 0.4, 0.8}) {
    const Vec3d wo = {0, 0, 1}, n = {0, h, std::sqrt(1 - h * h)};
    const Vec3d mirrored = 2 * Dot(wo, n) * n - wo;
    const Peak peak = BrightestAround(HairOf(0.2, 0.1, 0, h, 0), wo);
    INFO(h);
    CHECK(Length(peak.at - mirrored) < 5e-3);
  }
}

}  // namespace lanelight::test
