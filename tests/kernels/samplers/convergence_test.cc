// Orders of convergence of the samplers in two dimensions: slope of log RMSE over log N
// for N points of one replicate, over many pixels. What theory says (variance of sums of
// stratified errors): -1/2 independent; -1 jittered strata; -3/2 scrambled nets, up to
// logarithms; -1 Halton points; -3/4 for all of them at an edge.
// Numbers: -3/2 jittered strata.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "src/vocabulary/path/replicates.h"
#include "tests/kernels/samplers/draw.h"
#include "tests/kernels/samplers/slope.h"

namespace lanelight::test {
namespace {

using std::numbers::pi;

struct Integrand {
  std::function<double(double, double)> f;
  double exact;
};

const Integrand kProduct = {[](double x, double y) { return x * y; }, 0.25};
const Integrand kWaves = {
    [](double x, double y) { return std::cos(pi * x) * std::cos(2 * y); }, 0};
const Integrand kSum = {[](double x, double y) { return x * x - y; }, 1.0 / 3 - 0.5};
const Integrand kPeriodic = {
    [](double x, double y) { return x * (1 - x) * y * (1 - y) + std::cos(2 * pi * x); },
    1.0 / 36};
const Integrand kDisk = {[](double x, double y) { return x * x + y * y < 0.6 ? 1 : 0; },
                         0.6 * pi / 4};

enum class Plant { kNone, kRepeatedIndex };

// Root mean square error over pixels of the mean of N points of one replicate.
double Rmse(SampleSequence sampler, std::uint32_t n, const Integrand& integrand,
            Plant plant = Plant::kNone) {
  constexpr std::uint32_t kPixels = 256;
  Drawn p = Draw({sampler, 5, 1000, 7, 0, n, kPixels, kReplicates});
  if (plant == Plant::kRepeatedIndex) {
    for (std::vector<float>* u : {&p.u0, &p.u1}) {
      std::copy_n(u->begin(), kPixels, u->end() - kPixels);
    }
  }
  double sum = 0;
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0;
    for (std::size_t i = pixel; i < p.u0.size(); i += kPixels) {
      mean += integrand.f(p.u0[i], p.u1[i]);
    }
    const double error = mean / n - integrand.exact;
    sum += error * error;
  }
  return std::sqrt(sum / kPixels);
}

double Slope(SampleSequence sampler, const Integrand& integrand,
             Plant plant = Plant::kNone) {
  std::vector<double> n, rmse;
  for (std::uint32_t i = 4; i <= 4096; i *= 4) {
    n.push_back(i);
    rmse.push_back(Rmse(sampler, i, integrand, plant));
  }
  return LogSlope(n, rmse);
}

// Returns the slope for the mean of u^2 over one scalar dimension.
double NumberSlope(SampleSequence sampler) {
  constexpr std::uint32_t kPixels = 256;
  std::vector<double> n, rmse;
  for (std::uint32_t count = 4; count <= 4096; count *= 4) {
    const std::vector<float> u =
        DrawNumbers({sampler, 5, 1000, 7, 0, count, kPixels, kReplicates});
    double sum = 0;
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
      double mean = 0;
      for (std::size_t i = pixel; i < u.size(); i += kPixels) {
        mean += double(u[i]) * double(u[i]) / count;
      }
      sum += (mean - 1.0 / 3) * (mean - 1.0 / 3);
    }
    n.push_back(count);
    rmse.push_back(std::sqrt(sum / kPixels));
  }
  return LogSlope(n, rmse);
}

// The standard error of a slope is 0.008: 256 pixels give each RMSE within 4.4 %, and the
// logarithms of N have a spread of 5.8. Five of them for one false alarm in a million.
constexpr double kMargin = 0.05;

}  // namespace

TEST_CASE("independent points converge like N^-1/2", "[points]") {
  for (const Integrand& f : {kProduct, kWaves, kSum, kPeriodic, kDisk}) {
    CHECK(Slope(SampleSequence::kIndependent, f) == Approx(-0.5).margin(kMargin));
  }
}

TEST_CASE("jittered strata converge like N^-1", "[points]") {
  for (const Integrand& f : {kProduct, kWaves, kSum}) {
    CHECK(Slope(SampleSequence::kStratified, f) == Approx(-1).margin(kMargin));
  }
  CHECK(NumberSlope(SampleSequence::kStratified) == Approx(-1.5).margin(kMargin));
  CHECK(NumberSlope(SampleSequence::kIndependent) == Approx(-0.5).margin(kMargin));
}

TEST_CASE("scrambled nets converge nearly like N^-3/2", "[points]") {
  constexpr SampleSequence kSobol = SampleSequence::kSobol;
  for (const Integrand& f : {kProduct, kWaves}) CHECK(Slope(kSobol, f) < -1.3);
  CHECK(Slope(kSobol, kSum) == Approx(-1.5).margin(kMargin + 0.02));
  CHECK(Slope(kSobol, kPeriodic) < -1.2);
}

TEST_CASE("Halton points converge like N^-1", "[points]") {
  for (const Integrand& f : {kProduct, kWaves, kSum}) {
    CHECK(Slope(SampleSequence::kHalton, f) == Approx(-1).margin(2 * kMargin));
  }
}

TEST_CASE("edges bring all stratified points near N^-3/4", "[points]") {
  for (SampleSequence sampler : kAllSequences) {
    if (sampler == SampleSequence::kIndependent) continue;
    INFO(Name(sampler));
    CHECK(Slope(sampler, kDisk) == Approx(-0.75).margin(0.08));
  }
}

TEST_CASE("planted: one repeated index lowers the convergence order", "[points]") {
  for (const Integrand& f : {kSum, kProduct}) {
    CHECK(Slope(SampleSequence::kSobol, f, Plant::kRepeatedIndex) > -1.3);
  }
}

}  // namespace lanelight::test
