// Shading with a guide, on a hand-made wavefront: what it scatters has the density that
// it reports, the mixture of guide and material; light samples are weighed against it;
// delta lobes lose nothing.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/stages.h"
#include "src/image/octahedral.h"
#include "src/prepare/guide_square.h"
#include "src/prepare/tables.h"
#include "src/stat/hypothesis.h"
#include "tests/guide/random_guide.h"
#include "tests/shade/probe_batch.h"
#include "tests/stat/chi2.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kPaths = 1 << 15, kFew = 1000;
constexpr StageOn kFactories[] = {
#define X(name, traits, meaning) Shade##name##Stage,
    LANELIGHT_SHADE_KINDS(X)
#undef X
};

// Eval and Sample are density and f, not estimates of them.
bool HasDensity(const TestMaterial& m) {
  using enum ShadeKind;
  return !IsSpecular(m.kind) && m.kind != kCoatedConductor &&
         m.kind != kCoatedDiffuseMedium && m.kind != kCoatedConductorMedium;
}

// Paths that meet a surface with normal +z from wo, all in one cell of a lopsided guide.
struct GuidedPaths {
  CompiledScene scene;
  StrategyTables tables;
  WaveFixture fixture;
  std::uint32_t count;
  Vec3d seen_from;

  GuidedPaths(const TestMaterial& material, Vec3d wo, unsigned seed,
              std::uint32_t paths = kPaths)
      : fixture(scene, paths), count(paths), seen_from(wo) {
    scene.materials = material.table;
    tables.guide = RandomGuide({.seed = seed, .levels = 0, .decades = 3});
    fixture.run.tables = &tables;
    PathColumns& p = fixture.wave.path;
    p.color0_r = p.color0_g = p.color0_b = p.alpha_x = p.alpha_y = nullptr;
    p.color1_r = p.color1_g = p.color1_b = p.coat_thickness = p.coat_g = nullptr;
    reference::Random random(seed);
    const auto unit = [&] { return static_cast<float>(random.Bits() >> 40) * 0x1p-24f; };
    for (std::uint32_t i = 0; i < count; ++i) {
      p.pixel[i] = i, p.sample[i] = 0, p.depth[i] = 0, p.material[i] = 0, p.branch[i] = 0;
      Set(i, {0, 0, 1}, p.ng_x, p.ng_y, p.ng_z),
          Set(i, {0, 0, 1}, p.ns_x, p.ns_y, p.ns_z);
      Set(i, {1, 0, 0}, p.tg_x, p.tg_y, p.tg_z), Set(i, -1.0 * wo, p.d_x, p.d_y, p.d_z);
      Set(i, {0, 0, 0}, p.p_x, p.p_y, p.p_z), p.p_error[i] = 0;
      Set(i, {1, 1, 1}, p.beta_r, p.beta_g, p.beta_b);
      Set(i, RandomDirection(random), p.ls_x, p.ls_y, p.ls_z);
      Set(i, {1, 1, 1}, p.ls_r, p.ls_g, p.ls_b), p.ls_pdf[i] = 0.5f;
      p.u_lobe[i] = unit(), p.u_bsdf_0[i] = unit(), p.u_bsdf_1[i] = unit();
      p.u_guide[i] = unit();
      p.eta_scale[i] = 1, p.uv_v[i] = material.uv_v[0];
      p.bsdf_pdf[i] = -1, p.t[i] = 5;
    }
  }
  static void Set(std::uint32_t i, Vec3d v, float* x, float* y, float* z) {
    x[i] = static_cast<float>(v.x), y[i] = static_cast<float>(v.y);
    z[i] = static_cast<float>(v.z);
  }

  void Shade(ShadeKind kind, bool guided, bool mis = true) {
    FeatureSet features = {Feature::kScatters, Feature::kLights, Feature::kVertexNormals};
    if (guided) features.Add(Feature::kGuided);
    if (mis) features.Add(Feature::kMis);
    fixture.QueueAll(QueueId::kSurface, count);
    fixture.QueueAll(ShadeQueue(kind), count);
    if (guided) fixture.Run(GuideProposalsStage, features);
    fixture.Run(kFactories[static_cast<int>(kind)], features);
  }

  const PathColumns& path() const { return fixture.wave.path; }
  Vec3d Direction(std::uint32_t i) const {
    return {path().d_x[i], path().d_y[i], path().d_z[i]};
  }
  Vec3d ToLight(std::uint32_t i) const {
    return {path().ls_x[i], path().ls_y[i], path().ls_z[i]};
  }
  double Fraction() const { return tables.guide.fraction[0]; }
  // pdf_sa of the guide; the surface seen from above or from below.
  double GuideDensity(Vec3d d) const {
    const GuideSquarePoint at = Point(d);
    if (!(at.to_solid_angle > 0)) return 0;
    return double{tables.guide.density[SquareOf(d)]} * at.to_solid_angle;
  }
  GuideSquarePoint Point(Vec3d d) const {
    return ToGuideSquare({0, 0, seen_from.z > 0 ? 1.0 : -1.0}, d);
  }
  double Mixture(double guide, double material) const {
    return Fraction() * guide + (1 - Fraction()) * material;
  }
  std::size_t SquareOf(Vec3d d) const {
    const GuideSquarePoint at = Point(d);
    const auto part = [](double x) {
      return std::min(static_cast<std::size_t>(x * kGuideGrid),
                      std::size_t{kGuideGrid - 1});
    };
    return part(at.v) * kGuideGrid + part(at.u);
  }
  // Squares above, then those below.
  std::size_t BinOf(Vec3d d) const {
    return SquareOf(d) + (Point(d).to_solid_angle > 0 ? 0 : kGuideSquares);
  }
};
constexpr std::size_t kBins = 2 * kGuideSquares;

// Adds f(direction, value, material's pdf) times solid angle to the bins of directions.
template <class F>
void Integrate(const GuidedPaths& paths, const TestMaterial& m, Vec3d wo,
               const std::vector<Vec3d>& directions, std::vector<double>& bins, F f) {
  ProbeBatch batch(static_cast<std::uint32_t>(directions.size()));
  batch.SetWo(wo);
  for (std::uint32_t i = 0; i < batch.n; ++i) batch.SetWi(i, directions[i]);
  batch.Eval(m);
  for (std::uint32_t i = 0; i < batch.n; ++i) {
    if (!(batch.value[0][i] > 0)) continue;
    bins[paths.BinOf(directions[i])] += f(directions[i], double(batch.pdf[i])) / batch.n;
  }
}

// Expected numbers of paths that scatter into each bin, and of the others: the guide's
// part over the square, where it jumps at borders only; the material's over the sphere,
// where it is bounded.
std::vector<double> Expected(const GuidedPaths& paths, const TestMaterial& m, Vec3d wo) {
  constexpr std::uint32_t kSide = 16 * kGuideGrid, kOctahedral = 32 * kGuideGrid;
  std::vector<Vec3d> above, all;
  for (std::uint32_t k = 0; k < kSide * kSide; ++k) {
    above.push_back(FromGuideSquare({0, 0, paths.seen_from.z > 0 ? 1.0 : -1.0},
                                    (k % kSide + 0.5) / kSide,
                                    (k / kSide + 0.5) / kSide));
  }
  for (std::uint32_t k = 0; k < kOctahedral * kOctahedral; ++k) {
    all.push_back(OctahedralToDirection((k % kOctahedral + 0.5) / kOctahedral,
                                        (k / kOctahedral + 0.5) / kOctahedral));
  }
  std::vector<double> expected(kBins + 1);
  const double c = paths.Fraction();
  Integrate(paths, m, wo, above, expected, [&](Vec3d d, double) {
    return c * kPaths * 4 * paths.GuideDensity(d) / paths.Point(d).to_solid_angle;
  });
  Integrate(paths, m, wo, all, expected, [&](Vec3d, double pdf) {
    return (1 - c) * kPaths * 4 * std::numbers::pi * pdf;
  });
  double sum = 0;
  for (double e : expected) sum += e;
  expected.back() = std::max(kPaths - sum, 0.0);
  return expected;
}

std::vector<double> Observed(const GuidedPaths& paths) {
  std::vector<double> counts(kBins + 1);
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const bool found = paths.path().bsdf_pdf[i] > 0 && paths.path().beta_r[i] > 0;
    counts[found ? paths.BinOf(paths.Direction(i)) : kBins] += 1;
  }
  return counts;
}

// The emulation, which is slow, is asked about one direction.
template <class Body>
void ForEachSurface(Body body) {
  ForEachTarget([&](const std::string& target) {
    for (const TestMaterial& m : TestMaterials()) {
      if (!HasDensity(m)) continue;
      const Vec3d wo = Normalize(Vec3d{0.4, -0.3, m.name.size() % 2 == 0 ? 0.8 : -0.8});
      INFO(target << ", " << m.name);
      body(m, wo);
    }
  });
}

}  // namespace

TEST_CASE("guided surfaces scatter with the mixture of both densities", "[guide][stat]") {
  const double level =
      stat::SidakLevel(1e-4, static_cast<int>(TestMaterials().size()) * 2 *
                                 static_cast<int>(AvailableTargets().size()));
  ForEachSurface([&](const TestMaterial& m, Vec3d wo) {
    GuidedPaths paths(m, wo, 31);
    paths.Shade(m.kind, true);
    const std::vector<double> observed = Observed(paths);
    CHECK(stat::ChiSquareTest(observed, Expected(paths, m, wo)).p > level);
    // Without the material's part the test would see it.
    paths.tables.guide.fraction[0] = 0.99f;
    CHECK(stat::ChiSquareTest(observed, Expected(paths, m, wo)).p < 1e-9);
  });
}

TEST_CASE("guided paths weigh f cos over the mixture, and know its density", "[guide]") {
  ForEachSurface([&](const TestMaterial& m, Vec3d wo) {
    GuidedPaths paths(m, wo, 37);
    paths.Shade(m.kind, true);
    ProbeBatch eval(kPaths);
    eval.SetWo(wo);
    for (std::uint32_t i = 0; i < kPaths; ++i) eval.SetWi(i, paths.Direction(i));
    eval.Eval(m);
    std::uint32_t wrong = 0, seen = 0;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      const PathColumns& p = paths.path();
      if (!(p.bsdf_pdf[i] > 0) || !(p.beta_r[i] > 0)) continue;
      const double pdf =
          paths.Mixture(paths.GuideDensity(paths.Direction(i)), eval.pdf[i]);
      const bool close = std::abs(p.bsdf_pdf[i] / pdf - 1) < 5e-3 &&
                         std::abs(p.beta_g[i] * pdf / eval.value[1][i] - 1) < 5e-3;
      wrong += close ? 0 : 1, ++seen;
    }
    CHECK(seen > kPaths / 4);
    CHECK(wrong < seen / 500);  // rounding at the edges of leaves, and at the horizon
  });
}

TEST_CASE("roulette sees guided paths as the material would have sent them", "[guide]") {
  // A ray towards a lamp that the guide knows has a small throughput because it is
  // likely; roulette goes by throughput times eta_scale, for diffuse surfaces the albedo.
  TestMaterial white = TestMaterials().front();
  for (const TestMaterial& m : TestMaterials()) {
    if (m.kind == ShadeKind::kDiffuse) white = m;
  }
  REQUIRE(white.kind == ShadeKind::kDiffuse);
  GuidedPaths material(white, {0.3, 0.2, 0.9}, 5), guided(white, {0.3, 0.2, 0.9}, 5);
  material.Shade(white.kind, false);
  guided.Shade(white.kind, true);
  double lightest = 1e9, heaviest = 0;
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const double beta = double(guided.path().beta_r[i]);
    if (!(beta > 0)) continue;
    lightest = std::min(lightest, beta), heaviest = std::max(heaviest, beta);
    const double seen = beta * double(guided.path().eta_scale[i]);
    CHECK(seen == Approx(double(material.path().beta_r[0])).epsilon(1e-3));
  }
  CHECK(lightest < 0.2 * heaviest);
}

TEST_CASE("light samples are weighed against the mixture", "[guide]") {
  ForEachSurface([&](const TestMaterial& m, Vec3d wo) {
    GuidedPaths paths(m, wo, 41);
    ProbeBatch eval(kPaths);
    eval.SetWo(wo);
    for (std::uint32_t i = 0; i < kPaths; ++i) eval.SetWi(i, paths.ToLight(i));
    eval.Eval(m);
    paths.Shade(m.kind, true);
    std::uint32_t wrong = 0, seen = 0;
    for (std::uint32_t i = 0; i < kPaths; ++i) {
      if (!(eval.value[1][i] > 0)) continue;
      const double r =
          paths.Mixture(paths.GuideDensity(paths.ToLight(i)), eval.pdf[i]) / 0.5;
      const double expected = eval.value[1][i] / (1 + r * r);
      wrong += std::abs(paths.path().sh_g[i] / expected - 1) < 1e-2 ? 0 : 1, ++seen;
    }
    CHECK(seen > kPaths / 4);
    CHECK(wrong < seen / 500);
  });
}

TEST_CASE("a guide takes nothing from delta lobes", "[guide][stat]") {
  for (const TestMaterial& m : TestMaterials()) {
    if (m.kind != ShadeKind::kCoatedDiffuseSmooth) continue;
    const Vec3d wo = Normalize(Vec3d{0.9, 0, 0.3});
    double energy[2], error[2];
    for (const bool guided : {false, true}) {
      GuidedPaths paths(m, wo, 43);
      paths.tables.guide.fraction[0] = 0.5f;
      paths.Shade(m.kind, guided);
      double sum = 0, squares = 0;
      for (std::uint32_t i = 0; i < kPaths; ++i) {
        const double delta = paths.path().bsdf_pdf[i] == 0 ? paths.path().beta_g[i] : 0;
        sum += delta, squares += delta * delta;
      }
      energy[guided] = sum / kPaths;
      error[guided] = (squares / kPaths - energy[guided] * energy[guided]) / kPaths;
    }
    INFO(m.name);
    CHECK(energy[0] > 0.05);
    // 5 standard errors: a false alarm in 2e6.
    CHECK(std::abs(energy[1] - energy[0]) < 5 * std::sqrt(error[0] + error[1]));
    CHECK(10 * std::sqrt(error[0] + error[1]) < 0.2 * energy[0]);
  }
}

TEST_CASE("a guide that knows nothing changes nothing", "[guide]") {
  ForEachTarget([](const std::string& target) {
    for (const TestMaterial& m : TestMaterials()) {
      if (IsSpecular(m.kind)) continue;
      GuidedPaths plain(m, {0.6, 0, 0.8}, 47, kFew), guided(m, {0.6, 0, 0.8}, 47, kFew);
      guided.tables.guide = UnknowingGuide();
      plain.Shade(m.kind, false);
      guided.Shade(m.kind, true);
      const PathColumns &a = plain.path(), &b = guided.path();
      INFO(target << ", " << m.name);
      bool same = true;
      for (std::uint32_t i = 0; i < kFew; ++i) {
        same = same && a.d_x[i] == b.d_x[i] && a.beta_g[i] == b.beta_g[i] &&
               a.bsdf_pdf[i] == b.bsdf_pdf[i] && a.sh_b[i] == b.sh_b[i];
      }
      CHECK(same);
    }
  });
}

TEST_CASE("densities are written for records where no light is weighed", "[guide]") {
  const TestMaterial& m = TestMaterials()[0];
  GuidedPaths with(m, {0.6, 0, 0.8}, 53, kFew), without(m, {0.6, 0, 0.8}, 53, kFew);
  with.Shade(m.kind, true, true);
  without.Shade(m.kind, true, false);
  for (std::uint32_t i = 0; i < kFew; ++i) {
    REQUIRE(with.path().bsdf_pdf[i] == without.path().bsdf_pdf[i]);
  }
  CHECK(with.path().bsdf_pdf[0] > 0);
}

}  // namespace lanelight::test
