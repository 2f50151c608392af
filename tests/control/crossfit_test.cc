// Coefficients fitted to one half of the samples and used on the other: unbiased with few
// samples of skewed distributions, where fitting to all of them is not.
#include <catch2/catch.hpp>
#include <random>

#include "src/image/accumulator.h"
#include "src/image/control_film.h"
#include "tests/control/control_scenes.h"
#include "tests/reference/closed_forms.h"

namespace lanelight::test {
namespace {

// Who depends on whom.
enum class Model {
  kIndependent,
  kRepeated,    // sample 2k + 1 repeats sample 2k
  kStratified,  // those of a replicate, of which each has one number in each stratum
};

// D exponential less its mean 1, f its square: mean 2, E[f D^2] far from E[f] E[D^2].
struct Skewed {
  std::mt19937 engine;
  Model model;
  Skewed(Model m, unsigned seed) : engine(seed), model(m) {}

  double Uniform() { return std::uniform_real_distribution<double>()(engine); }
  // The samples of a pixel.
  void Draw(std::vector<float>& f, std::vector<float>& d) {
    const std::size_t n = f.size(), turns = (n + kReplicates - 1) / kReplicates;
    double u = 0, shifts[kReplicates];
    for (double& shift : shifts) shift = Uniform();
    for (std::size_t i = 0; i < n; ++i) {
      if (model != Model::kRepeated || i % 2 == 0) u = Uniform();
      if (model == Model::kStratified) {
        u = shifts[i % kReplicates] + double(i / kReplicates) / double(turns);
        u -= std::floor(u);
      }
      const double x = -std::log1p(-u);
      f[i] = static_cast<float>(x * x);
      d[i] = static_cast<float>(x - 1);
    }
  }
};
constexpr double kMean = 2;

// How far the mean over many estimates is from the truth, in standard errors.
struct Score {
  double n = 0, sum = 0, squares = 0;
  void Add(double v) {
    n += 1;
    sum += v;
    squares += v * v;
  }
  double Z(double truth) const {
    const double mean = sum / n, variance = (squares / n - mean * mean) / (n - 1);
    return (mean - truth) / std::sqrt(variance);
  }
};

struct Scores {
  Score cross, same;
  double variance = 0;  // mean of what the film says
};

// Pixels of `spp` samples that count as `groups`; fitted by the film, and by the twin
// that uses the samples which the coefficient multiplies.
Scores Simulate(int side, std::uint32_t spp, const SampleGroups& groups, Model model,
                unsigned seed) {
  Skewed skewed(model, seed);
  FilmAccumulator film(0, 0, side, side, groups, Auxiliary::kNone);
  film.UseDifferences();
  Scores out;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      std::vector<float> f(spp), d(spp);
      skewed.Draw(f, d);
      ControlSums sums;
      for (std::uint32_t i = 0; i < spp; ++i) sums.Add(double(f[i]), double(d[i]));
      const float* planes[] = {f.data(), f.data(), f.data(),
                               d.data(), d.data(), d.data()};
      film.AddSamples(x, y, planes, spp);
      ControlScatter all;
      all.Add(sums);
      out.same.Add((sums.f - FitCoefficient(all, all) * sums.d) / sums.n);
    }
  }
  film.FitControl();
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      out.cross.Add(film.Mean(x, y).x);
      out.variance += film.Variance(x, y).x / (side * side);
    }
  }
  return out;
}

// Two-sided 1e-6 is 4.9 standard errors; the family of these tests shares it.
constexpr double kReject = 5.5;

}  // namespace

TEST_CASE("cross-fitted coefficients are unbiased, others are not", "[control]") {
  for (std::uint32_t spp : {8u, 11u, 16u}) {
    const Scores s = Simulate(160, spp, {1, false}, Model::kIndependent, spp);
    INFO(spp << " samples: " << s.cross.Z(kMean) << " " << s.same.Z(kMean));
    CHECK(std::abs(s.cross.Z(kMean)) < kReject);
    CHECK(std::abs(s.same.Z(kMean)) > 2 * kReject);
  }
}

TEST_CASE("cross-fitting by pairs, with one that is open", "[control]") {
  for (std::uint32_t spp : {16u, 27u}) {
    const Scores s = Simulate(160, spp, {2, false}, Model::kRepeated, spp);
    CHECK(std::abs(s.cross.Z(kMean)) < kReject);
    // Planted: halves that depend on each other.
    const Scores torn = Simulate(220, spp, {1, false}, Model::kRepeated, spp);
    CHECK(std::abs(torn.cross.Z(kMean)) > 2 * kReject);
  }
}

TEST_CASE("cross-fitting by replicates, complete and not", "[control]") {
  for (std::uint32_t spp : {4u, 8u, 16u, 19u, 25u}) {
    INFO(spp << " samples");
    const Scores s = Simulate(160, spp, {1, true}, Model::kStratified, spp);
    CHECK(std::abs(s.cross.Z(kMean)) < kReject);
    const Scores pairs = Simulate(160, 2 * spp, {2, true}, Model::kRepeated, spp);
    CHECK(std::abs(pairs.cross.Z(kMean)) < kReject);
  }
  // Planted: replicates of single samples, where pairs depend on each other.
  const Scores torn = Simulate(320, 4, {1, true}, Model::kRepeated, 9);
  CHECK(std::abs(torn.cross.Z(kMean)) > 2 * kReject);
}

TEST_CASE("cross-fitting alone in a pixel", "[control]") {
  for (bool replicates : {false, true}) {
    Score cross;
    for (unsigned seed = 0; seed < 4000; ++seed) {
      Scores one = Simulate(1, 12, {1, replicates}, Model::kIndependent, 1000 + seed);
      cross.Add(one.cross.sum);
    }
    CHECK(std::abs(cross.Z(kMean)) < kReject);
  }
}

TEST_CASE("the film's variance is that of the corrected mean", "[control]") {
  for (bool replicates : {false, true}) {
    const Scores s = Simulate(128, 64, {1, replicates}, Model::kIndependent, 5);
    const double n = s.cross.n, mean = s.cross.sum / n;
    const double seen = s.cross.squares / n - mean * mean;
    INFO("replicates " << replicates << ": " << s.variance << ", seen " << seen);
    CHECK(s.variance == Approx(seen).epsilon(0.1));
    // Cov(x^2, x) / Var(x) = 4 and r^2 = 16 / 20: four fifths of the variance 20 / 64 go.
    CHECK(seen < 0.35 * 20 / 64);
  }
}

TEST_CASE("coefficients of differences that do not vary are zero", "[control]") {
  ControlSums sums;
  for (double f : {1.0, 3.0, 2.0, 7.0}) sums.Add(f, 0);
  ControlScatter scatter;
  scatter.Add(sums);
  CHECK(FitCoefficient(scatter, scatter) == 0);
  CHECK(scatter.Correlation() == 0);
  CHECK(FitCoefficient({}, {}) == 0);
  ControlSums rounding;  // follows f, but is no more than its last digits
  for (double f : {1.0, 3.0, 2.0, 7.0}) rounding.Add(f, 1e-7 * f);
  ControlScatter tiny;
  tiny.Add(rounding);
  CHECK(FitCoefficient(tiny, tiny) == 0);
  ControlSums linear;
  for (double d : {-1.0, 0.5, 0.25, 2.0}) linear.Add(4 + 0.75 * d, d);
  ControlScatter fit;
  fit.Add(linear);
  CHECK(FitCoefficient(fit, fit) == Approx(0.75));
  CHECK(fit.Correlation() == Approx(1));
}

TEST_CASE("optimal control with few samples has the closed form's mean", "[control]") {
  const int size = 48;
  const std::vector<Vec3d> corners = PolygonCorners();
  const auto exact = stat::KnownImage(size, size, [&](int x, int y) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      const Vec3d p = FilmPoint(x + (k % 2 + 0.5) / 2, y + (k / 2 + 0.5) / 2, size);
      sum += closed_form::PolygonIrradiance(3, corners, p, {0, 0, 1}) / 4;
    }
    return Grey(0.5 / std::numbers::pi * sum);
  });
  for (const char* strategy :
       {"control=analytic", "control=analytic,directions=light",
        "control=analytic,points=sobol", "control=analytic,pairs=antithetic"}) {
    const Rendered render = RenderWith(PolygonLight(size), strategy, 16);
    const auto result =
        stat::CompareMeans(Estimate(render), exact, {12, 1e-6, 5e-4, 1e-6});
    INFO(strategy << ": " << result.ToString());
    CHECK(result.same);
    CHECK(result.detectable_bias < 0.01);
  }
}

}  // namespace lanelight::test
