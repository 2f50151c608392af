// Environments behind portals: samples against the rectangle that a portal is, and
// against the density that rays through it know (chi-square tests); renders against the
// reference with every way of sampling.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/stages.h"
#include "src/base/core/error.h"
#include "src/base/stat/hypothesis.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/lights/image_strategies.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

// A hall that the sky enters through a window in its side x = 2, for portals.
constexpr double kSill = 0.5, kTop = 1.7, kLeft = -0.8, kRight = 0.9;
std::vector<Vec3d> Window() {
  return {{2, kLeft, kSill}, {2, kLeft, kTop}, {2, kRight, kTop}, {2, kRight, kSill}};
}

SceneDescription Hall() {
  SceneBuilder b(8, 8);
  b.Depth(2).Perspective({-1.8, -1.6, 1}, {2, 0.6, 1}, {0, 0, 1}, 75);
  const Index wall = b.AddDiffuse({0.6, 0.5, 0.4});
  b.AddQuad({-4, -2, 0}, {6, 0, 0}, {0, 4, 0}, wall);
  b.AddQuad({-4, -2, 2}, {0, 4, 0}, {6, 0, 0}, wall);
  b.AddQuad({-4, 2, 0}, {6, 0, 0}, {0, 0, 2}, wall);
  // The wall around the window.
  b.AddQuad({2, -2, 0}, {0, 4, 0}, {0, 0, kSill}, wall);
  b.AddQuad({2, -2, kTop}, {0, 4, 0}, {0, 0, 2 - kTop}, wall);
  b.AddQuad({2, -2, kSill}, {0, 2 + kLeft, 0}, {0, 0, kTop - kSill}, wall);
  b.AddQuad({2, kRight, kSill}, {0, 2 - kRight, 0}, {0, 0, kTop - kSill}, wall);
  b.AddEnvironment({1, 2, 3});
  SceneDescription scene = b.Build();
  scene.lights.back().portal = Window();
  return scene;
}

SceneDescription HallUnderMap() {
  SceneDescription scene = Hall();
  Light& sky = scene.lights.back();
  sky.image_path = Picture("sky.exr", kSquare, kSquare, Patchwork);
  sky.emission = {1, 1, 1};
  sky.image_scale = 1.5;
  sky.world_from_light = Transform::Rotate(35, {0.3, 1, 0.2});
  return scene;
}

// Van Oosterom and Strackee 1983.
double SolidAngleOfTriangle(Vec3d a, Vec3d b, Vec3d c) {
  const double x = Length(a), y = Length(b), z = Length(c);
  return 2 * std::abs(std::atan2(Dot(a, Cross(b, c)), x * y * z + Dot(a, b) * z +
                                                          Dot(b, c) * x + Dot(c, a) * y));
}

constexpr std::uint32_t kRandomPaths = 1 << 14;

struct PortalSamples {
  PreparedScene scene;
  std::uint32_t n;
  WaveFixture fixture;

  // All from one place of the world, with numbers that are evenly spread or random.
  PortalSamples(const SceneDescription& description, Vec3d from, bool random = false)
      : scene(PrepareScene(description)),
        n(random ? kRandomPaths : kImagePaths),
        fixture(scene.Parts(), n) {
    PathColumns& p = fixture.wave.path;
    p.light_pmf = nullptr;
    const Vec3d at = (from - scene.compiled->center) * scene.compiled->scale;
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::uint32_t i = 0; i < n; ++i) {
      p.p_x[i] = float(at.x), p.p_y[i] = float(at.y), p.p_z[i] = float(at.z);
      p.o_x[i] = p.p_x[i], p.o_y[i] = p.p_y[i], p.o_z[i] = p.p_z[i];
      p.u_light_0[i] = (float(i) + 0.5f) / float(n);
      const double golden = 0.5 + i * 0.6180339887498949;
      p.u_light_1[i] =
          float(std::floor((golden - std::floor(golden)) * 0x1p24) * 0x1p-24);
      if (random) p.u_light_0[i] = unit(engine), p.u_light_1[i] = unit(engine);
      p.ls_light[i] = 0;
    }
    fixture.QueueAll(QueueId::kLit, n);
    fixture.Run(SamplePortalLightStage, scene.compiled->features);
  }
};

// The density of samples that a ray along d from `from` knows, by the weight it takes: a
// material's density of 1 makes that of the heuristic of powers 1 / (1 + pdf^2), one that
// outweighs all 1.
std::vector<double> KnownDensities(const PreparedScene& scene, Vec3d from,
                                   const std::vector<Vec3d>& directions) {
  const auto n = static_cast<std::uint32_t>(directions.size());
  const Vec3d at = (from - scene.compiled->center) * scene.compiled->scale;
  std::vector<float> weighed[2];
  for (int k = 0; k < 2; ++k) {
    WaveFixture fixture(scene.Parts(), n);
    fixture.run.mis = MakeMisParameters(Strategy{});
    PathColumns& p = fixture.wave.path;
    p.light_pmf = nullptr;
    for (std::uint32_t i = 0; i < n; ++i) {
      p.o_x[i] = float(at.x), p.o_y[i] = float(at.y), p.o_z[i] = float(at.z);
      p.d_x[i] = float(directions[i].x), p.d_y[i] = float(directions[i].y);
      p.d_z[i] = float(directions[i].z);
      p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = 1;
      p.l_r[i] = p.l_g[i] = p.l_b[i] = 0;
      p.bsdf_pdf[i] = k == 0 ? 1.0f : 1e9f;
    }
    fixture.QueueAll(QueueId::kMiss, n);
    fixture.Run(EscapeStage, scene.compiled->features);
    weighed[k].assign(p.l_r, p.l_r + n);
  }
  std::vector<double> pdf(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    REQUIRE(weighed[0][i] > 0);
    pdf[i] = std::sqrt(std::max(0.0, double(weighed[1][i]) / weighed[0][i] - 1));
  }
  return pdf;
}

constexpr int kCells = 10, kInCell = 16;  // of the window along each side; in a cell

Vec3d InWindow(double y, double z) {
  return {2, kLeft + (kRight - kLeft) * y, kSill + (kTop - kSill) * z};
}

// Integrals of the density over the cells of the window, by midpoints.
std::vector<double> CellProbabilities(const PreparedScene& scene, Vec3d from) {
  constexpr int kSide = kCells * kInCell;
  std::vector<Vec3d> directions;
  std::vector<double> solid_angle;
  for (int k = 0; k < kSide * kSide; ++k) {
    const Vec3d to =
        InWindow((k % kSide + 0.5) / kSide, (k / kSide + 0.5) / kSide) - from;
    const double r = Length(to), area = (kRight - kLeft) * (kTop - kSill);
    directions.push_back(to / r);
    solid_angle.push_back(area / (kSide * kSide) * to.x / (r * r * r));
  }
  const std::vector<double> pdf = KnownDensities(scene, from, directions);
  std::vector<double> cells(kCells * kCells, 0);
  for (int k = 0; k < kSide * kSide; ++k) {
    cells[k / kSide / kInCell * kCells + k % kSide / kInCell] += pdf[k] * solid_angle[k];
  }
  return cells;
}

double PortalPValue(const SceneDescription& sampled, const SceneDescription& claimed,
                    Vec3d from) {
  PortalSamples s(sampled, from, true);
  const PathColumns& p = s.fixture.wave.path;
  std::vector<double> expected = CellProbabilities(PrepareScene(claimed), from);
  double sum = 0;
  for (double& e : expected) sum += e, e *= s.n;
  CHECK(sum == Approx(1).epsilon(0.01));
  for (double& e : expected) e /= sum;  // what midpoints are off by
  std::vector<double> counts(expected.size(), 0);
  for (std::uint32_t i = 0; i < s.n; ++i) {
    const Vec3d d = {p.ls_x[i], p.ls_y[i], p.ls_z[i]};
    const Vec3d q = from + d * ((2 - from.x) / d.x);
    const auto cell = [](double x, double low, double high) {
      return std::clamp(int((x - low) / (high - low) * kCells), 0, kCells - 1);
    };
    counts[cell(q.z, kSill, kTop) * kCells + cell(q.y, kLeft, kRight)] += 1;
  }
  return stat::ChiSquareTest(counts, expected).p;
}

}  // namespace

TEST_CASE("portal samples cover the window with their stated density", "[lights]") {
  const Vec3d places[] = {{0, 0, 1}, {1.9, -0.7, 0.1}, {-1.5, 1.5, 1.8}};
  const EachTarget target;
  for (const Vec3d from : places) {
    CAPTURE(from.x, from.y, from.z);
    const auto w = Window();
    const double angle = SolidAngleOfTriangle(w[0] - from, w[1] - from, w[2] - from) +
                         SolidAngleOfTriangle(w[0] - from, w[2] - from, w[3] - from);
    for (const SceneDescription& hall : {Hall(), HallUnderMap()}) {
      PortalSamples s(hall, from);
      const PathColumns& p = s.fixture.wave.path;
      double covered = 0;
      for (std::uint32_t i = 0; i < kImagePaths; ++i) {
        REQUIRE(p.ls_pdf[i] > 0);
        const Vec3d d = {p.ls_x[i], p.ls_y[i], p.ls_z[i]};
        const Vec3d q = from + d * ((2 - from.x) / d.x);
        CHECK((d.x > 0 && q.y > kLeft - 1e-3 && q.y < kRight + 1e-3));
        CHECK((q.z > kSill - 1e-3 && q.z < kTop + 1e-3));
        covered += 1 / (double(p.ls_pdf[i]) * kImagePaths);
      }
      CHECK(covered == Approx(angle).epsilon(0.01));
    }
  }
  // Outside there is nothing to be seen through it.
  PortalSamples outside(Hall(), {2.5, 0, 1});
  for (std::uint32_t i = 0; i < kImagePaths; ++i) {
    CHECK(outside.fixture.wave.path.ls_r[i] == 0);
  }
}

TEST_CASE("a ray through a portal computes the density of its sample", "[lights]") {
  const EachTarget target;
  PortalSamples s(HallUnderMap(), {0.5, 0.3, 0.6});
  PathColumns& p = s.fixture.wave.path;
  s.fixture.run.mis = MakeMisParameters(Strategy{});
  for (std::uint32_t i = 0; i < kImagePaths; ++i) {
    p.d_x[i] = p.ls_x[i], p.d_y[i] = p.ls_y[i], p.d_z[i] = p.ls_z[i];
    p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = 1;
    p.l_r[i] = p.l_g[i] = p.l_b[i] = 0;
    p.bsdf_pdf[i] = p.ls_pdf[i];  // then the weight is one half
  }
  s.fixture.QueueAll(QueueId::kMiss, kImagePaths);
  s.fixture.Run(EscapeStage, s.scene.compiled->features);
  std::uint32_t off = 0;  // on a texel's edge
  for (std::uint32_t i = 0; i < kImagePaths; ++i) {
    const double want = 0.5 * p.ls_r[i] * p.ls_pdf[i];
    off += !(p.l_r[i] == Approx(want).epsilon(1e-4));
  }
  CHECK(off < kImagePaths / 200);
}

// The family of all places, maps and targets raises a false alarm with probability 1e-3.
TEST_CASE("densities of portal samples equal those computed by rays", "[lights][stat]") {
  const Vec3d places[] = {{0, 0, 1}, {1.5, -0.4, 0.3}, {-1.5, 1.5, 1.8}};
  const double level =
      stat::SidakLevel(1e-3, static_cast<int>(6 * AvailableTargets().size()));
  const EachTarget target;
  for (const Vec3d from : places) {
    CAPTURE(from.x, from.y, from.z);
    CHECK(PortalPValue(Hall(), Hall(), from) > level);
    CHECK(PortalPValue(HallUnderMap(), HallUnderMap(), from) > level);
  }
  // Another density is rejected.
  CHECK(PortalPValue(HallUnderMap(), Hall(), places[0]) < 1e-6);
}

TEST_CASE("environments behind portals agree with the reference", "[lights]") {
  SECTION("of one radiance") { CheckStrategies(Hall()); }
  SECTION("of a map") { CheckStrategies(HallUnderMap()); }
}

TEST_CASE("a portal must be a rectangle", "[lights]") {
  SceneDescription hall = Hall();
  CHECK_NOTHROW(PrepareScene(hall));
  hall.lights.back().portal[2].z += 0.1;
  CHECK_THROWS_AS(PrepareScene(hall), InputError);
}

}  // namespace lanelight::test
