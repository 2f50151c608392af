#include "src/base/stat/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/base/core/check.h"
#include "src/base/stat/distributions.h"

namespace lanelight::stat {
namespace {

// (sum V_i)^2 / sum(V_i^2 / dof_i), with the denominator given.
double Satterthwaite(double variance, double sum_of_squares_over_dof) {
  return sum_of_squares_over_dof > 0 ? variance * variance / sum_of_squares_over_dof
                                     : 1e9;
}

}  // namespace

MeanEstimate Average(const std::vector<MeanEstimate>& estimates, double as_one) {
  LL_CHECK(!estimates.empty());
  const double n = static_cast<double>(estimates.size());
  MeanEstimate out;
  double quartic = 0;
  for (const MeanEstimate& e : estimates) {
    const double v = e.variance / (n * n);
    out.mean += e.mean / n;
    out.variance += v;
    if (v > 0) quartic += v * v / e.dof;
  }
  out.dof = Satterthwaite(out.variance, quartic);
  const double each = std::min(as_one, n);
  if (each > 1) {
    out.dof = std::max(estimates[0].dof, out.dof / each);
    out.variance *= each;
  }
  return out;
}

double WelchPValue(const MeanEstimate& a, const MeanEstimate& b, double tolerance) {
  const double variance = a.variance + b.variance;
  if (!std::isfinite(a.mean - b.mean) || !std::isfinite(variance)) return 0;
  const double difference = std::max(0.0, std::abs(a.mean - b.mean) - tolerance);
  if (difference == 0) return 1;
  if (variance == 0) return 0;
  const double quartic = (a.variance > 0 ? a.variance * a.variance / a.dof : 0) +
                         (b.variance > 0 ? b.variance * b.variance / b.dof : 0);
  return StudentTwoSided(difference / std::sqrt(variance),
                         Satterthwaite(variance, quartic));
}

double SidakLevel(double family, int n) {
  LL_CHECK(family > 0 && family < 1 && n >= 1);
  return -std::expm1(std::log1p(-family) / n);
}

// A martingale M of variance V exceeds sqrt((V + r) log((V + r) / (r a^2))) at any time
// with probability a at most (Ville's inequality for the mixture); here r = 1, in units
// of the variance at the first look, and over the standard error sqrt(V).
double TimeUniformQuantile(double growth, double confidence) {
  const double alpha = 1 - confidence;
  return std::sqrt((1 + 1 / growth) * std::log((growth + 1) / (alpha * alpha)));
}

std::vector<std::size_t> HolmRejections(std::span<const double> p, double family) {
  LL_CHECK(family > 0 && family < 1);
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto value = [&](std::size_t i) { return std::isnan(p[i]) ? 2 : p[i]; };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
  std::size_t rejected = 0;
  while (rejected < p.size() &&
         value(order[rejected]) <= family / static_cast<double>(p.size() - rejected)) {
    ++rejected;
  }
  order.resize(rejected);
  std::sort(order.begin(), order.end());
  return order;
}

Consensus ConsensusOf(std::span<const MeanEstimate> measurements, double min_variance) {
  LL_CHECK(!measurements.empty() && min_variance > 0);
  const auto weight = [&](const MeanEstimate& m) {
    return 1 / std::max(m.variance, min_variance);
  };
  double weights = 0, mean = 0, quartic = 0, chi_square = 0;
  for (const MeanEstimate& m : measurements) weights += weight(m);
  for (const MeanEstimate& m : measurements) {
    const double fraction = weight(m) / weights;
    mean += fraction * m.mean;
    quartic += fraction * fraction / std::max(m.dof, 1.0);
  }
  for (const MeanEstimate& m : measurements) {
    chi_square += weight(m) * (m.mean - mean) * (m.mean - mean);
  }
  Consensus out;
  const double freedom = double(measurements.size()) - 1;
  if (freedom > 0) out.birge = std::max(1.0, chi_square / freedom);
  out.estimate = {mean, out.birge / weights, 1 / quartic};
  return out;
}

double DeparturePValue(const MeanEstimate& one, std::span<const MeanEstimate> others,
                       double min_variance) {
  if (others.empty()) return 1;
  const Consensus consensus = ConsensusOf(others, min_variance);
  MeanEstimate own = one;
  own.variance = std::max(own.variance, min_variance) * consensus.birge;
  return WelchPValue(own, consensus.estimate);
}

}  // namespace lanelight::stat
