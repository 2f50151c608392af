// Every material samples the density it reports: chi-square over directions, weights that
// are f cos / density, densities that integrate to what is not lost or specular.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "src/base/stat/hypothesis.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/shade/probe_batch.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

constexpr int kRows = 16, kColumns = 16, kSub = 16;  // equal areas
constexpr int kFineRows = kRows * kSub, kFineColumns = kColumns * kSub;
constexpr std::uint32_t kSamples = 1 << 15;

// Rows of x, columns of the angle around the x axis: the poles lie in the horizon, away
// from the lobes, and the horizon falls on the edges of columns.
int Cell(Vec3d w) {
  const double turn = std::atan2(w.z, w.y) / (2 * std::numbers::pi) + 0.5;
  const int row = std::clamp(static_cast<int>((w.x + 1) / 2 * kRows), 0, kRows - 1);
  const int column = std::clamp(static_cast<int>(turn * kColumns), 0, kColumns - 1);
  return row * kColumns + column;
}

// Expected counts by midpoints of the density that Eval reports; the last cell is what is
// absorbed or specular.
std::vector<double> Expected(const TestMaterial& material, Vec3d wo) {
  ProbeBatch batch(kFineRows * kFineColumns);
  batch.SetWo(wo);
  for (int i = 0; i < kFineRows * kFineColumns; ++i) {
    const double x = (i / kFineColumns + 0.5) * 2 / kFineRows - 1;
    const double turn = (i % kFineColumns + 0.5) / kFineColumns - 0.5;
    const double phi = 2 * std::numbers::pi * turn, r = std::sqrt(1 - x * x);
    batch.SetWi(i, {x, r * std::cos(phi), r * std::sin(phi)});
  }
  batch.Eval(material);
  const double area = 4 * std::numbers::pi / batch.n;
  std::vector<double> counts(kRows * kColumns + 1, 0);
  double total = 0;
  for (std::uint32_t i = 0; i < batch.n; ++i) {
    counts[Cell(batch.Wi(i))] += kSamples * batch.pdf[i] * area;
    total += batch.pdf[i] * area;
  }
  counts.back() = kSamples * std::max(0., 1 - total);
  CHECK(total < 1.004);
  return counts;
}

std::vector<double> Observed(const TestMaterial& material, Vec3d wo) {
  ProbeBatch batch(kSamples);
  batch.SetWo(wo);
  batch.RandomPoints(3);
  batch.Sample(material);
  std::vector<double> counts(kRows * kColumns + 1, 0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const bool found = batch.pdf[i] > 0 && batch.value[0][i] > 0;
    counts[found ? Cell(batch.Wi(i)) : counts.size() - 1] += 1;
  }
  return counts;
}

// Random walks in coats have no density in closed form.
bool HasDensity(const TestMaterial& m) {
  using enum ShadeKind;
  return !IsSpecular(m.kind) && m.kind != kCoatedConductor &&
         m.kind != kCoatedDiffuseMedium && m.kind != kCoatedConductorMedium;
}

}  // namespace

TEST_CASE("materials sample the density they report", "[shade][stat]") {
  int tests = 0;
  for (const TestMaterial& m : TestMaterials()) tests += HasDensity(m);
  tests *= static_cast<int>(TestDirections().size() * AvailableTargets().size());
  const double level = stat::SidakLevel(1e-3, tests);
  const EachTarget target;
  for (const TestMaterial& m : TestMaterials()) {
    if (!HasDensity(m)) continue;
    for (Vec3d wo : TestDirections(target.name())) {
      INFO(m.name << ", wo.z = " << wo.z);
      CHECK(stat::ChiSquareTest(Observed(m, wo), Expected(m, wo)).p > level);
    }
  }
}

TEST_CASE("the density of another roughness is rejected", "[shade][stat]") {
  for (const TestMaterial& m : TestMaterials()) {
    if (!HasDensity(m) || m.local.interface.ax == 0) continue;
    TestMaterial other = m;
    // The coat is a small part of the density of plastic.
    const bool coated = m.local.kind == MaterialKind::kCoatedDiffuse;
    other.table.alpha_x[0] *= coated ? 2 : 1.2f;
    INFO(m.name);
    const Vec3d wo = TestDirections()[1];
    CHECK(stat::ChiSquareTest(Observed(m, wo), Expected(other, wo)).p < 1e-6);
  }
}

TEST_CASE("sample weights are f cos over density", "[shade]") {
  const EachTarget target;
  for (const TestMaterial& m : TestMaterials()) {
    if (!HasDensity(m)) continue;
    for (Vec3d wo : TestDirections(target.name())) {
      ProbeBatch sample(4096);
      sample.SetWo(wo);
      sample.RandomPoints(5);
      sample.Sample(m);
      ProbeBatch eval = sample;
      eval.Eval(m);
      double worst = 0, worst_pdf = 0;
      for (std::uint32_t i = 0; i < sample.n; ++i) {
        // Directions within float rounding of the horizon change sides.
        if (!(sample.pdf[i] > 0) || !(sample.value[1][i] > 0)) continue;
        if (std::abs(sample.wi[2][i]) < 1e-4) continue;
        for (int c = 0; c < 3; ++c) {
          const double ratio = eval.value[c][i] / eval.pdf[i];
          worst = std::max(worst, std::abs(ratio / sample.value[c][i] - 1));
        }
        worst_pdf =
            std::max<double>(worst_pdf, std::abs(eval.pdf[i] / sample.pdf[i] - 1));
      }
      INFO(m.name << ", wo.z = " << wo.z);
      CHECK(worst < 2e-3);
      CHECK(worst_pdf < 5e-3);
    }
  }
}

}  // namespace lanelight::test
