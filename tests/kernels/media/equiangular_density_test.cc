// distances=equiangular, chi-square: where points in a medium fall against the density of
// Kulla and Fajardo (2012) in balance with that of transmittance, and the density that
// the throughput of a path tells.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/stages.h"
#include "src/base/stat/hypothesis.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/base/stat/chi2.h"
#include "tests/kernels/media/scenes.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight::test {
namespace {

constexpr std::uint32_t kWalks = 1 << 17;
constexpr std::size_t kSlices = 64;

// A point light beside the z axis.
struct Beside {
  double h, a;      // distance from the axis; along it
  double fraction;  // of the power of all lights
};

// A ray from the origin along the z axis up to a surface.
struct Walks {
  Rgb sigma_a, sigma_s;
  double length;
  std::vector<Beside> lights;
  double by_angle = 0.5;  // share of the points that lights draw

  SceneDescription Scene() const {
    SceneBuilder b(1, 1);
    b.Depth(3).Perspective({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1);
    b.AddQuad({-1, -1, length}, {0, 2, 0}, {2, 0, 0}, b.AddDiffuse(Grey(0.5)));
    for (const Beside& l : lights) b.AddPoint({l.h, 0, l.a}, Grey(4 * l.fraction));
    b.scene().camera.medium = AddMedium(b, MakeMedium(sigma_a, sigma_s));
    SceneDescription scene = b.Build();
    ApplyStrategy("distances=equiangular", {}, scene.strategy);
    return scene;
  }
  // Share of the angle of the ray, seen from a light, that is passed at d.
  double Turned(const Beside& light, double d) const {
    const auto angle = [&](double x) { return std::atan((x - light.a) / light.h); };
    return (angle(d) - angle(0)) / (angle(length) - angle(0));
  }
  // Probability of a point before d, for the mean channel.
  double Before(double d) const {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double sigma = sigma_a[c] + sigma_s[c];
      double turned = 0;
      for (const Beside& light : lights) turned += light.fraction * Turned(light, d);
      sum += (1 - by_angle) * (1 - std::exp(-sigma * d)) +
             by_angle * (1 - std::exp(-sigma * length)) * turned;
    }
    return sum / 3;
  }
};

// Distances of points, in the world; -1 for walks that reach the surface. Throughputs.
struct Walked {
  std::vector<double> distance;
  std::vector<Rgb> beta;

  explicit Walked(const Walks& walks) {
    const PreparedScene scene = PrepareScene(walks.Scene());
    REQUIRE(scene.chances->anchors.size() == walks.lights.size());
    WaveFixture fixture(scene.Parts(), kWalks);
    FeatureSet features = scene.compiled->features;
    features.Add(Feature::kEquiangularDistances);
    fixture.run.features = features;
    fixture.run.max_depth = 3;
    PathColumns& p = fixture.wave.path;
    p.branch = p.crossings = nullptr;
    const auto o =
        VecCast<float>(Vec3d{} - scene.compiled->center) * float(scene.compiled->scale);
    std::mt19937 engine(29);
    for (std::uint32_t i = 0; i < kWalks; ++i) {
      fixture.SetRay(i, {o, {0, 0, 1}, float(walks.length * scene.compiled->scale)});
      p.pixel[i] = 0, p.sample[i] = i, p.depth[i] = 0, p.medium[i] = 0;
      p.beta_r[i] = p.beta_g[i] = p.beta_b[i] = 1;
      p.odds_r[i] = p.odds_g[i] = p.odds_b[i] = 1;
      p.u_medium_0[i] = float(engine() >> 8) * 0x1p-24f;
      p.u_medium_1[i] = float(engine() >> 8) * 0x1p-24f;
    }
    fixture.QueueAll(QueueId::kActive, kWalks);
    fixture.Run(MediumDistanceStage, features);
    for (std::uint32_t i = 0; i < kWalks; ++i) {
      distance.push_back(p.t[i] < 0 ? (p.p_z[i] - o.z) / scene.compiled->scale : -1);
      beta.push_back({p.beta_r[i], p.beta_g[i], p.beta_b[i]});
    }
  }
};

// Slices of one probability each, and the surface.
double DistancesPValue(const Walked& walked, const Walks& claimed) {
  const double all = claimed.Before(claimed.length);
  std::vector<double> counts(kSlices + 1, 0),
      expected(kSlices + 1, kWalks * all / kSlices);
  expected[kSlices] = kWalks * (1 - all);
  for (const double d : walked.distance) {
    const double fraction = claimed.Before(d) / all;
    ++counts[d < 0 ? kSlices : std::min(std::size_t(fraction * kSlices), kSlices - 1)];
  }
  return stat::ChiSquareTest(counts, expected).p;
}

std::vector<Walks> SomeWalks() {
  const Rgb thin_a = {0.01, 0.02, 0.01}, thin_s = {0.05, 0.1, 0.2};
  return {{{0.05, 0.1, 0.4}, {0.3, 0.6, 0.2}, 4, {{0.7, 2, 1}}},
          {thin_a, thin_s, 3, {{0.1, 1, 1}}},
          {{0, 0, 0}, {1, 1, 1}, 2, {{0.4, -0.5, 1}}},
          {thin_a, thin_s, 5, {{0.2, 1, 0.75}, {0.5, 4, 0.25}}}};
}

}  // namespace

// The family of all walks and targets raises a false alarm with probability 1e-6.
TEST_CASE("media: equiangular samples have the theoretical density", "[media][stat]") {
  const std::vector<Walks> all = SomeWalks();
  const double level =
      stat::SidakLevel(1e-6, int(all.size() * AvailableTargets().size()));
  const EachTarget target;
  for (const Walks& walks : all) {
    CAPTURE(walks.length, walks.lights.size());
    const Walked walked(walks);
    CHECK(DistancesPValue(walked, walks) > level);
    // Another share of points by the angle is rejected.
    Walks wrong = walks;
    wrong.by_angle = 0.4;
    CHECK(DistancesPValue(walked, wrong) < 1e-6);
  }
}

TEST_CASE("media: throughputs contain the density of equiangular samples", "[media]") {
  const EachTarget target;
  for (const Walks& walks : SomeWalks()) {
    if (walks.lights.size() > 1) continue;  // they know of the one drawn only
    const Walked walked(walks);
    std::uint32_t off = 0;
    for (std::uint32_t i = 0; i < kWalks; ++i) {
      const double d = walked.distance[i], step = 1e-4;
      const bool event = d >= 0;
      const double pdf =
          event ? (walks.Before(d + step) - walks.Before(d - step)) / (2 * step)
                : 1 - walks.Before(walks.length);
      for (int c = 0; c < 3; ++c) {
        const double sigma = walks.sigma_a[c] + walks.sigma_s[c];
        const double found = std::exp(-sigma * (event ? d : walks.length)) *
                             (event ? walks.sigma_s[c] : 1);
        off += !(walked.beta[i][c] == Approx(found / pdf).epsilon(1e-3));
      }
    }
    CAPTURE(walks.length);
    CHECK(off == 0);
  }
}

}  // namespace lanelight::test
