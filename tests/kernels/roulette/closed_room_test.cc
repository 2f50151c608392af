// Roulette in a room whose walls all emit 1 and reflect a: every scattering event is like
// every other, so the length of paths and the variance have closed forms.
//
// directions=bsdf: a path that is alive after k events has met emission 1 with weight
// a^k, and nothing else adds to it. Constant roulette with s = 1 - q after every event:
//   x = sum_{k=0}^{K} r^k,  r = a / s,  P(K >= k) = s^k
//   E[x] = sum r^k s^k = 1 / (1 - a)
//   E[x^2] = sum_{j,k} r^(j+k) s^max(j,k)
//          = sum_k (r^2 s)^k + 2 sum_k s^k r^k (r^k - 1) / (r - 1)
//          = A + 2 / (r - 1) (A - 1 / (1 - a)),  A = 1 / (1 - a^2 / s) if a^2 < s
//   E[rays] = sum_k s^k = 1 / q, Var[rays] = s / q^2
#include <catch2/catch.hpp>
#include <random>

#include "src/base/stat/hypothesis.h"
#include "tests/agreement/agreement.h"
#include "tests/reference/closed_forms.h"

namespace lanelight::test {
namespace {

constexpr double kFalseAlarm = 1e-6;

struct Moments {
  double mean = 0, variance = 0;
};

Moments ConstantRouletteMoments(double a, double q) {
  const double s = 1 - q, r = a / s, mean = 1 / (1 - a);
  const double sum = 1 / (1 - a * a / s);
  return {mean, sum + 2 / (r - 1) * (sum - mean) - mean * mean};
}

Rendered RenderRoom(double albedo, int depth, const std::string& roulette,
                    std::uint64_t spp) {
  TestRender t;
  t.spp = spp;
  t.strategy = "directions=bsdf,roulette=" + roulette;
  return RenderDescription(ClosedRoom(albedo, depth), t);
}

// Variance of one sample, as 16 pixels estimate it.
stat::MeanEstimate SampleVariance(const FilmAccumulator& film) {
  std::vector<double> v;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      v.push_back(film.Variance(x, y).y * double(film.Samples(x, y)));
    }
  }
  double sum = 0, squares = 0;
  for (double s : v) sum += s, squares += s * s;
  const double n = double(v.size()), mean = sum / n;
  return {mean, (squares / n - mean * mean) / (n - 1), n - 1};
}

// The same estimator in plain loops; without `divide`, survivors keep their weight: the
// planted error.
stat::ImageEstimate ScalarTwin(double a, double q, bool divide, int n) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> uniform;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    double x = 1, weight = 1;
    while (uniform(engine) >= q) {
      weight *= divide ? a / (1 - q) : a;
      x += weight;
    }
    sum += x, squares += x * x;
  }
  const double mean = sum / n, variance = (squares / n - mean * mean) / (n - 1);
  return {1, 1, double(n), {Grey(mean)}, {Grey(variance)}};
}

stat::ImageTestResult AgainstRoom(const stat::ImageEstimate& image, double albedo) {
  return stat::CompareMeans(
      image,
      stat::ExpectedImage(image.width, image.height,
                          [&](int, int) { return Grey(1 / (1 - albedo)); }),
      {4, kFalseAlarm, kFloatTolerance, 0});
}

}  // namespace

TEST_CASE("constant roulette: mean, variance and path length of the closed room",
          "[roulette]") {
  for (const auto& [a, q] : {std::pair{0.5, 0.25}, {0.7, 0.2}, {0.5, 0.6}}) {
    INFO("albedo " << a << ", q " << q);
    const Rendered r = RenderRoom(a, 1000, "constant:" + std::to_string(q), 1u << 14);
    const auto mean = AgainstRoom(Estimate(r), a);
    INFO(mean.ToString());
    CHECK(mean.same);
    CHECK(mean.detectable_bias < 0.02);

    const Moments moments = ConstantRouletteMoments(a, q);
    const stat::MeanEstimate variance = SampleVariance(r.film);
    INFO("variance " << variance.mean << " +- " << std::sqrt(variance.variance)
                     << ", closed form " << moments.variance);
    CHECK(stat::WelchPValue(variance, {moments.variance, 0, 0}) > kFalseAlarm);

    const double n = double(r.result.samples);
    const double rays = double(r.result.rays_closest) / n;
    INFO("rays " << rays << ", closed form " << 1 / q);
    // Five standard errors: 6e-7.
    CHECK(std::abs(rays - 1 / q) < 5 * std::sqrt((1 - q) / n) / q);
  }
}

TEST_CASE("the closed form of the variance distinguishes probabilities", "[roulette]") {
  const stat::MeanEstimate variance =
      SampleVariance(RenderRoom(0.5, 1000, "constant:0.25", 1u << 15).film);
  for (double wrong : {0.22, 0.28}) {
    CHECK(stat::WelchPValue(variance, {ConstantRouletteMoments(0.5, wrong).variance, 0,
                                       0}) < kFalseAlarm);
  }
}

TEST_CASE("a missing 1 / (1 - q) is rejected", "[roulette]") {
  const int n = 1 << 16;
  CHECK(AgainstRoom(ScalarTwin(0.5, 0.25, true, n), 0.5).same);
  CHECK_FALSE(AgainstRoom(ScalarTwin(0.5, 0.25, false, n), 0.5).same);
  // Even where little is lost by it.
  CHECK(AgainstRoom(ScalarTwin(0.5, 0.02, true, n), 0.5).same);
  CHECK_FALSE(AgainstRoom(ScalarTwin(0.5, 0.02, false, n), 0.5).same);
}

TEST_CASE("without roulette the closed room has no variance and full paths",
          "[roulette]") {
  const Rendered r = RenderRoom(0.5, 20, "none", 64);
  CHECK(r.result.rays_closest == 21 * r.result.samples);
  CHECK(ImageMean(r.film).y ==
        Approx(closed_form::ClosedRoom(1, 0.5, 20)).epsilon(kFloatTolerance));
  // Rounding of the hits only.
  CHECK(SampleVariance(r.film).mean < 1e-8);
}

TEST_CASE("throughput roulette: path length of the closed room", "[roulette]") {
  // The first decision, after two events, is survived with a^2 and gives weight 1 back;
  // every later one with a.
  for (double a : {0.3, 0.7}) {
    const Rendered r = RenderRoom(a, 1000, "throughput", 1u << 13);
    CHECK(AgainstRoom(Estimate(r), a).same);
    const double n = double(r.result.samples);
    const double rays = 2 + a * a / (1 - a);
    // Var: Bernoulli(a^2) times a geometric number of mean 1 / (1 - a).
    const double second = a * a * (1 + a) / ((1 - a) * (1 - a));
    const double variance = second - std::pow(a * a / (1 - a), 2);
    CHECK(std::abs(double(r.result.rays_closest) / n - rays) <
          5 * std::sqrt(variance / n));
  }
}

TEST_CASE("roulettes that split keep the mean of the closed room", "[roulette]") {
  for (const char* roulette : {"throughput:0.05", "adjoint"}) {
    for (double a : {0.5, 0.9}) {
      TestRender t;
      t.spp = 1u << 13;
      t.strategy = std::string("roulette=") + roulette;
      const Rendered r = RenderDescription(ClosedRoom(a, 300), t);
      const auto result = AgainstRoom(Estimate(r), a);
      INFO(roulette << ", albedo " << a << ": " << result.ToString());
      CHECK(result.same);
      CHECK(result.detectable_bias < 0.05);
    }
  }
}

}  // namespace lanelight::test
