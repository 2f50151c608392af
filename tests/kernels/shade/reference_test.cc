// Materials against the scalar reference (tests/reference/bsdf.h): its own formulas, in
// double, with explicit random walks for coats.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "src/base/stat/hypothesis.h"
#include "tests/kernels/shade/probe_batch.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kEvaluated = 1 << 15;
constexpr int kMoments = 4;

// Bounded functions of the direction; together they see sides, tilt and spread.
double Moment(int which, Vec3d w) {
  const double shapes[] = {1, w.z, w.z * w.z, w.x + 0.5 * w.y * w.z};
  return shapes[which];
}

struct Sums {
  double n = 0, sum[kMoments][3] = {}, squares[kMoments][3] = {};
  void Add(Rgb weight, Vec3d wi) {
    n += 1;
    if (weight == Rgb{}) return;
    for (int m = 0; m < kMoments; ++m) {
      for (int c = 0; c < 3; ++c) {
        const double v = weight[c] * Moment(m, wi);
        sum[m][c] += v;
        squares[m][c] += v * v;
      }
    }
  }
  stat::MeanEstimate Estimate(int m, int c) const {
    const double mean = sum[m][c] / n;
    return {mean, std::max(0., squares[m][c] / n - mean * mean) / (n - 1), n - 1};
  }
};

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

Sums Reference(const TestMaterial& material, Vec3d wo) {
  reference::Random random(37);
  Sums sums;
  for (std::uint32_t i = 0; i < kEvaluated; ++i) {
    const auto sample = reference::SampleBsdf(material.local, wo, random);
    sums.Add(sample ? sample->weight : Rgb{}, sample ? sample->wi : Vec3d{0, 0, 1});
  }
  return sums;
}

// Smallest p-value over moments and channels; differences of 0.002 do not count (tables
// and single precision).
double LowestP(const Sums& a, const Sums& b) {
  double lowest = 1;
  for (int m = 0; m < kMoments; ++m) {
    for (int c = 0; c < 3; ++c) {
      const double p = stat::WelchPValue(a.Estimate(m, c), b.Estimate(m, c), 2e-3);
      lowest = std::min(lowest, p);
    }
  }
  return lowest;
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
  std::vector<std::vector<Sums>> reference;
  for (const TestMaterial& m : TestMaterials()) {
    reference.emplace_back();
    for (Vec3d wo : TestDirections()) reference.back().push_back(Reference(m, wo));
  }
  ForEachTarget([&](const std::string& target) {
    for (std::size_t i = 0; i < TestMaterials().size(); ++i) {
      for (std::size_t d = 0; d < TestDirections().size(); ++d) {
        if (target == "EMU128" && d != 1) continue;  // the slowest, and the same code
        const TestMaterial& m = TestMaterials()[i];
        INFO(target << ", " << m.name << ", wo.z = " << TestDirections()[d].z);
        CHECK(LowestP(Sampled(m, TestDirections()[d], true), reference[i][d]) > Level());
      }
    }
  });
}

TEST_CASE("samples agree with their own evaluation in the mean", "[shade][stat]") {
  ForEachTarget([&](const std::string& target) {
    if (target == "EMU128") return;  // the slowest, and the code is the same
    for (const TestMaterial& m : TestMaterials()) {
      if (IsSpecular(m.kind)) continue;
      for (Vec3d wo : TestDirections()) {
        INFO(target << ", " << m.name << ", wo.z = " << wo.z);
        CHECK(LowestP(Sampled(m, wo, false), Evaluated(m, wo)) > Level());
      }
    }
  });
}

TEST_CASE("a wrong material is told from the reference", "[shade][stat]") {
  for (const TestMaterial& m : TestMaterials()) {
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
    for (Vec3d wo : TestDirections()) {
      lowest = std::min(lowest, LowestP(Sampled(other, wo, true), Reference(m, wo)));
    }
    INFO(m.name);
    CHECK(lowest < 1e-6);
  }
}

TEST_CASE("evaluation agrees with the reference direction by direction", "[shade]") {
  ForEachTarget([&](const std::string& target) {
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
        INFO(target << ", " << m.name << ", wo.z = " << wo.z);
        CHECK(worst < 1e-2);  // near total reflection, of what little gets through
        CHECK(mean < 2e-5);
      }
    }
  });
}

}  // namespace lanelight::test
