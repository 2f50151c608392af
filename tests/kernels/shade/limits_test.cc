// Exact properties and extreme parameters of the materials.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/kernels/shade/probe_batch.h"
#include "tests/support/each_target.h"

namespace lanelight::test {
namespace {

bool Sane(float v) { return v >= 0 && v <= std::numeric_limits<float>::max(); }

struct Faults {
  int sample = 0, eval = 0, length = 0;
};

// NaN, infinite or negative values among what is sampled and evaluated from wo.
Faults CountFaults(const TestMaterial& m, Vec3d wo) {
  Faults faults;
  ProbeBatch batch(1024);
  batch.SetWo(wo);
  batch.RandomPoints(51);
  const float corners[] = {0, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
  for (int i = 0; i < 64; ++i) {  // the corners of the sample points
    batch.u[0][i] = corners[i % 4];
    batch.u[1][i] = corners[i / 4 % 4];
    batch.u[2][i] = corners[i / 16];
  }
  batch.Sample(m);
  for (std::uint32_t i = 0; i < batch.n; ++i) {
    const Rgb w = batch.Value(i);
    const bool clean =
        Sane(batch.value[0][i]) && Sane(batch.value[1][i]) && Sane(batch.value[2][i]);
    if (clean && w == Rgb{}) continue;  // absorbed: nothing else of it is read
    faults.sample += !clean || !Sane(batch.pdf[i]) || !Sane(batch.eta_scale[i]);
    faults.length += !(std::abs(Length(batch.Wi(i)) - 1) < 1e-3);
  }
  if (IsSpecular(m.kind)) return faults;
  const auto evaluate = [&] {
    batch.Eval(m);
    for (std::uint32_t i = 0; i < batch.n; ++i) {
      faults.eval += !Sane(batch.pdf[i]) || !Sane(batch.value[0][i]) ||
                     !Sane(batch.value[1][i]) || !Sane(batch.value[2][i]);
    }
  };
  evaluate();                                       // of the directions just found
  for (std::uint32_t i = 0; i < batch.n; i += 3) {  // the horizon
    const double x = batch.u[1][i], z = i % 2 ? 1e-7 : -1e-7;
    batch.SetWi(i, {x, std::sqrt(1 - x * x), z});
  }
  evaluate();
  return faults;
}

// The test materials with extreme parameters in place of their own.
std::vector<TestMaterial> ExtremeMaterials() {
  std::vector<TestMaterial> list;
  for (const TestMaterial& m : TestMaterials()) {
    for (double alpha : {1e-4, 1e-3, 1.0}) {
      for (double index : {1 + 1e-6, 1.0, 0.4, 1.5, 2.5}) {
        reference::LocalMaterial local = m.local;
        if (local.interface.ax > 0) local.interface = {alpha, alpha};
        if (local.metal.ax > 0) local.metal = {alpha, alpha};
        local.index = index;
        list.push_back(MakeTestMaterial(m.name, m.kind, local));
      }
    }
  }
  return list;
}

}  // namespace

TEST_CASE("extreme roughness, indices and angles stay finite", "[shade]") {
  const std::vector<TestMaterial> extreme = ExtremeMaterials();
  const EachTarget target;
  for (const TestMaterial& m : extreme) {
    if (target.name() == "EMU128" && m.local.interface.ax == 1) continue;  // the slowest
    for (double z : {1e-7, -1e-4, 0.02, 1.0}) {
      const Faults faults = CountFaults(m, {std::sqrt(1 - z * z), 0, z});
      INFO(m.name << ", alpha " << m.local.interface.ax << ", index " << m.local.index
                  << ", wo.z = " << z);
      CHECK(faults.sample == 0);
      CHECK(faults.eval == 0);
      CHECK(faults.length == 0);
    }
  }
}

TEST_CASE("diffuse weights are exactly the albedo", "[shade]") {
  const EachTarget target;
  for (int i = 0; i < 3; ++i) {
    const TestMaterial& m = TestMaterials()[i];
    ProbeBatch batch(1000);
    batch.RandomPoints(1);
    batch.SetWo({0.6, 0, -0.8});
    batch.Sample(m);
    int wrong = 0;
    for (std::uint32_t j = 0; j < batch.n; ++j) {
      const bool albedo = batch.value[0][j] == 0.8f && batch.value[1][j] == 0.5f;
      wrong += !albedo || batch.wi[2][j] >= 0;
    }
    INFO(m.name);
    CHECK(wrong == 0);
  }
}

TEST_CASE("no material creates energy", "[shade]") {
  const EachTarget target;
  for (const TestMaterial& m : TestMaterials()) {
    for (Vec3d wo : TestDirections(target.name())) {
      ProbeBatch batch(1 << 14);
      batch.SetWo(wo);
      batch.RandomPoints(61);
      batch.Sample(m);
      double energy = 0, squares = 0;  // of the first channel, the brightest in all
      for (std::uint32_t i = 0; i < batch.n; ++i) {
        const double e = batch.Value(i).x * batch.eta_scale[i];
        energy += e / batch.n;
        squares += e * e / batch.n;
      }
      const double error = std::sqrt(std::max(0., squares - energy * energy) / batch.n);
      INFO(m.name << ", wo.z = " << wo.z);
      CHECK(energy < 1 + 1e-5 + 4.5 * error);
      CHECK(energy > 0.05);
    }
  }
}

TEST_CASE("reciprocity", "[shade]") {
  // f(wi, wo) = eta^2 f(wo, wi) where wi is inside of what wo is outside of.
  using K = ShadeKind;
  const EachTarget target;
  for (const TestMaterial& m : TestMaterials()) {
    const bool applies = m.kind == K::kDiffuse || m.kind == K::kConductorRough ||
                         m.kind == K::kDielectricRough ||
                         m.kind == K::kCoatedDiffuseRough ||
                         m.kind == K::kCoatedDiffuseSmooth;
    if (!applies) continue;
    ProbeBatch forward(2048);
    forward.SetWo(TestDirections()[1]);
    forward.RandomPoints(71);
    forward.Sample(m);
    ProbeBatch backward = forward;
    for (int c = 0; c < 3; ++c) std::swap(backward.wo[c], backward.wi[c]);
    forward.Eval(m);
    backward.Eval(m);
    double worst = 0;
    int compared = 0;
    for (std::uint32_t i = 0; i < forward.n; ++i) {
      const double zi = std::abs(forward.wi[2][i]), zo = std::abs(forward.wo[2][i]);
      if (zi < 1e-3 || forward.pdf[i] <= 0) continue;
      const double scale = forward.wi[2][i] < 0 ? m.local.index * m.local.index : 1;
      const double f = forward.value[0][i] / zi * scale, g = backward.value[0][i] / zo;
      // Near total reflection 1 - F is small and only its absolute error is.
      worst = std::max(worst, std::abs(f - g) / (g + 0.01));
      ++compared;
    }
    INFO(m.name);
    CHECK(compared > 500);
    CHECK(worst < 2e-3);
  }
}

}  // namespace lanelight::test
