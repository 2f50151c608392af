// Materials against the scalar reference (tests/reference/bsdf.h): its own formulas, in
// double, with explicit random walks for coats.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/kernels/shade/moments.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kEvaluated = 1 << 15;

Sums Sampled(const TestMaterial& material, Vec3d wo, bool with_specular) {
  ProbeBatch batch(kEvaluated);
  batch.SetWo(wo);
  batch.RandomPoints(17);
  batch.Sample(material, 23);
  Sums sums;
  for (std::uint32_t i = 0; i < kEvaluated; ++i) {
    const bool counts = with_specular || batch.pdf[i] > 0;
    sums.Add(counts ? batch.Value(i) : Rgb{}, batch.Wi(i));
  }
  return sums;
}

// Integral of Eval over uniform directions.
Sums Evaluated(const TestMaterial& material, Vec3d wo) {
  ProbeBatch batch(kEvaluated * 4);
  batch.SetWo(wo);
  reference::Random random(29);
  for (std::uint32_t i = 0; i < batch.n; ++i) batch.SetWi(i, RandomDirection(random));
  batch.Eval(material, 31);
  Sums sums;
  for (std::uint32_t i = 0; i < batch.n; ++i) {
    sums.Add(batch.Value(i) * (4 * std::numbers::pi), batch.Wi(i));
  }
  return sums;
}

// Returns the sums of each material and direction, computed once.
const std::vector<std::vector<Sums>>& References() {
  static const std::vector<std::vector<Sums>> references = [] {
    std::vector<std::vector<Sums>> list;
    for (const TestMaterial& m : TestMaterials()) {
      list.emplace_back();
      for (Vec3d wo : TestDirections()) list.back().push_back(ReferenceSums(m, wo));
    }
    return list;
  }();
  return references;
}

double Level() {
  const std::size_t cases =
      TestMaterials().size() * AvailableTargets().size() * TestDirections().size();
  return stat::SidakLevel(1e-3, static_cast<int>(cases) * kMoments * 3);
}

bool IsWalk(const TestMaterial& m) {
  return m.local.kind == MaterialKind::kCoatedDiffuse ||
         m.local.kind == MaterialKind::kCoatedConductor;
}

}  // namespace

TEST_CASE("samples agree with the reference in the mean", "[shade][stat]") {
  const EachTarget target;
  for (std::size_t i = 0; i < TestMaterials().size(); ++i) {
    for (std::size_t d = 0; d < TestDirections().size(); ++d) {
      if (target.name() == "EMU128" && d != 1)
        continue;  // the slowest, and the same code
      const TestMaterial& m = TestMaterials()[i];
      INFO(m.name << ", wo.z = " << TestDirections()[d].z);
      CHECK(LowestP(Sampled(m, TestDirections()[d], true), References()[i][d]) > Level());
    }
  }
}

TEST_CASE("samples agree with their own evaluation in the mean", "[shade][stat]") {
  const EachTarget target;
  if (target.name() == "EMU128") return;  // the slowest, and the code is the same
  for (const TestMaterial& m : TestMaterials()) {
    if (IsSpecular(m.kind)) continue;
    for (Vec3d wo : TestDirections()) {
      INFO(m.name << ", wo.z = " << wo.z);
      CHECK(LowestP(Sampled(m, wo, false), Evaluated(m, wo)) > Level());
    }
  }
}

TEST_CASE("a wrong material is detected", "[shade][stat]") {
  for (std::size_t i = 0; i < TestMaterials().size(); ++i) {
    const TestMaterial& m = TestMaterials()[i];
    TestMaterial other = m;
    other.table.color0_g[0] *= 1.1f;  // albedo, or index of a metal
    other.table.color0_b[0] *= 0.5f;
    other.table.eta[0] *= 1.1f;
    for (const MeasuredRecord& record : m.table.measured.records) {
      float* reflectance = other.table.measured.values.data() + record.reflectance.at;
      std::for_each(reflectance, other.table.measured.values.end().base(),
                    [](float& v) { v *= 1.1f; });
    }
    double lowest = 1;
    for (std::size_t d = 0; d < TestDirections().size(); ++d) {
      lowest = std::min(
          lowest, LowestP(Sampled(other, TestDirections()[d], true), References()[i][d]));
    }
    INFO(m.name);
    CHECK(lowest < 1e-6);
  }
}

TEST_CASE("evaluation agrees with the reference direction by direction", "[shade]") {
  const EachTarget target;
  for (const TestMaterial& m : TestMaterials()) {
    if (IsSpecular(m.kind) || IsWalk(m)) continue;
    for (Vec3d wo : TestDirections()) {
      ProbeBatch batch(4096);
      batch.SetWo(wo);
      batch.RandomPoints(41);
      batch.Sample(m);  // half the directions sampled, half uniform
      reference::Random random(43);
      for (std::uint32_t i = 0; i < batch.n; i += 2)
        batch.SetWi(i, RandomDirection(random));
      batch.Eval(m);
      double worst = 0, mean = 0;
      for (std::uint32_t i = 0; i < batch.n; ++i) {
        const Rgb want = reference::EvaluateCos(m.local, Normalize(batch.Wo(i)),
                                                Normalize(batch.Wi(i)), random);
        for (int c = 0; c < 3; ++c) {
          const double difference = std::abs(batch.value[c][i] - want[c]);
          const double error = difference / (std::abs(want[c]) + 1e-5);
          worst = std::max(worst, error);
          mean += error / (3. * batch.n);
        }
      }
      INFO(m.name << ", wo.z = " << wo.z);
      CHECK(worst < 1e-2);  // near total reflection, of what little gets through
      CHECK(mean < 2e-5);
    }
  }
}

}  // namespace lanelight::test
