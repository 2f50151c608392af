// directions=uniform through the shading stages: directions even over the hemisphere or
// the sphere, throughput f |cos| / p, specular lobes by a fair coin. Everything is
// compared with the scalar reference, path by path or in the mean.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/stages.h"
#include "tests/kernels/shade/moments.h"
#include "tests/kernels/shade/shade_stages.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kPaths = (1 << 14) - 3;  // never a multiple of a vector
const FeatureSet kFeatures = {Feature::kUniformDirections, Feature::kScatters};

bool Transmits(ShadeKind kind) {
  return kind == ShadeKind::kDielectricRough || kind == ShadeKind::kDiffuseTransmission ||
         kind == ShadeKind::kHair;
}
bool HasSpecularLobe(ShadeKind kind) {
  using enum ShadeKind;
  return kind == kCoatedDiffuseSmooth || kind == kCoatedConductor ||
         kind == kCoatedDiffuseMedium || kind == kCoatedConductorMedium;
}
bool IsWalk(ShadeKind kind) {
  return HasSpecularLobe(kind) || kind == ShadeKind::kCoatedDiffuseRough;
}
double Density(ShadeKind kind) {
  return (Transmits(kind) ? 0.25 : 0.5) / std::numbers::pi;
}

// One bounce of many paths that arrive from the same side at a surface in local
// coordinates.
struct Bounces {
  CompiledScene scene;
  WaveFixture fixture;

  Bounces(const TestMaterial& material, Vec3d wo) : fixture(scene, kPaths) {
    scene.materials = material.table;
    PathColumns& p = fixture.wave.path;
    p.color0_r = p.color0_g = p.color0_b = p.alpha_x = p.alpha_y = nullptr;
    p.color1_r = p.color1_g = p.color1_b = p.coat_thickness = p.coat_g = nullptr;
    p.sh_r = p.sh_g = p.sh_b = nullptr;
    p.branch = nullptr;
    reference::Random random(83);
    const auto unit = [&] { return static_cast<float>(random.Bits() >> 40) * 0x1p-24f; };
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      p.pixel[i] = i, p.sample[i] = 0, p.depth[i] = 0, p.material[i] = 0;
      p.ng_x[i] = p.ng_y[i] = p.ns_x[i] = p.ns_y[i] = 0, p.ng_z[i] = p.ns_z[i] = 1;
      p.tg_x[i] = 1, p.tg_y[i] = p.tg_z[i] = 0;
      p.d_x[i] = static_cast<float>(-wo.x), p.d_y[i] = static_cast<float>(-wo.y);
      p.d_z[i] = static_cast<float>(-wo.z);
      p.p_x[i] = p.p_y[i] = p.p_z[i] = p.p_error[i] = 0;
      p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = 1;
      p.u_lobe[i] = unit(), p.u_bsdf_0[i] = unit(), p.u_bsdf_1[i] = unit();
      p.eta_scale[i] = 1, p.uv_v[i] = material.uv_v[0];
    }
    fixture.QueueAll(ShadeQueue(material.kind), kPaths);
    fixture.Run(kShadeStages[static_cast<int>(material.kind)], kFeatures);
  }
  Vec3d Wi(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    return {p.d_x[i], p.d_y[i], p.d_z[i]};
  }
  Rgb Beta(std::uint32_t i) const {
    const PathColumns& p = fixture.wave.path;
    return {p.beta_r[i], p.beta_g[i], p.beta_b[i]};
  }
};

Sums SumsOf(const Bounces& bounces, double factor) {
  Sums sums;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    sums.Add(bounces.Beta(i) * factor, bounces.Wi(i));
  }
  return sums;
}

std::vector<const TestMaterial*> Materials() {
  std::vector<const TestMaterial*> out;
  for (const TestMaterial& m : TestMaterials()) {
    if (!IsSpecular(m.kind)) out.push_back(&m);
  }
  return out;
}

}  // namespace

TEST_CASE("uniform: throughput times density is f cos, path by path", "[directions]") {
  const EachTarget target;
  for (const TestMaterial* m : Materials()) {
    if (IsWalk(m->kind)) continue;
    for (Vec3d wo : TestDirections(target.name())) {
      const Bounces bounces(*m, wo);
      reference::Random random(97);
      double worst = 0, mean = 0;
      for (std::uint32_t i = 0; i < kPaths; ++i) {
        const Vec3d wi = Normalize(bounces.Wi(i));
        const Rgb want = reference::EvaluateCos(m->local, Normalize(wo), wi, random);
        for (int c = 0; c < 3; ++c) {
          const double got = bounces.Beta(i)[c] * Density(m->kind);
          const double error = std::abs(got - want[c]) / (std::abs(want[c]) + 1e-4);
          worst = std::max(worst, error);
          mean += error / (3. * kPaths);
        }
      }
      INFO(m->name << ", wo.z = " << wo.z);
      // The worst is near total reflection, where what gets through is one minus a
      // reflectance close to one: off by rounding errors of one.
      CHECK(worst < 5e-3);
      CHECK(mean < 2e-5);
    }
  }
}

TEST_CASE("uniform: directions are uniform on the side of wo or on both sides",
          "[directions]") {
  const auto materials = Materials();
  const double n = kPaths;
  const EachTarget target;
  for (const TestMaterial* m : materials) {
    if (HasSpecularLobe(m->kind)) continue;
    const Vec3d wo = Normalize(Vec3d{0.3, -0.2, -0.8});
    const Bounces bounces(*m, wo);
    Vec3d sum;
    double squares = 0, above = 0;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      const Vec3d wi = bounces.Wi(i);
      sum += Vec3d{wi.x, wi.y, std::abs(wi.z)};
      squares += wi.z * wi.z;
      above += wi.z > 0;
    }
    INFO(m->name);
    // Means of coordinates that are uniform in height: variances 1/3, 1/3, 1/12 and,
    // of the square of the height, 4/45. Five standard errors.
    CHECK(std::abs(sum.x / n) < 5 * std::sqrt(1 / 3. / n));
    CHECK(std::abs(sum.y / n) < 5 * std::sqrt(1 / 3. / n));
    CHECK(std::abs(sum.z / n - 0.5) < 5 * std::sqrt(1 / 12. / n));
    CHECK(std::abs(squares / n - 1 / 3.) < 5 * std::sqrt(4 / 45. / n));
    if (Transmits(m->kind)) {
      CHECK(std::abs(above / n - 0.5) < 5 * std::sqrt(0.25 / n));
    } else {
      CHECK(above == 0);
    }
  }
}

TEST_CASE("uniform: scattered radiance agrees with the reference on average",
          "[directions][stat]") {
  const auto materials = Materials();
  static std::vector<std::vector<Sums>> reference;  // the same for all targets
  for (std::size_t i = reference.size(); i < materials.size(); ++i) {
    reference.emplace_back();
    for (Vec3d wo : TestDirections()) {
      reference.back().push_back(ReferenceSums(*materials[i], wo));
    }
  }
  const int tests = static_cast<int>(materials.size() * TestDirections().size() *
                                     AvailableTargets().size()) *
                    kMoments * 3;
  const double level = stat::SidakLevel(1e-3, tests);
  double min_wrong = 0;
  const EachTarget target;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    double wrong = 1;
    for (std::size_t d = 0; d < TestDirections().size(); ++d) {
      const Bounces bounces(*materials[i], TestDirections()[d]);
      INFO(materials[i]->name << ", direction " << d);
      CHECK(LowestP(SumsOf(bounces, 1), reference[i][d]) > level);
      wrong = std::min(wrong, LowestP(SumsOf(bounces, 1.5), reference[i][d]));
    }
    min_wrong = std::max(min_wrong, wrong);
  }
  // A weight that is off by half is found in every material; the density of the sphere in
  // place of the hemisphere's would be off by two.
  CHECK(min_wrong < 1e-6);
}

}  // namespace lanelight::test
