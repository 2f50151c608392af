#include "src/base/stat/hypothesis.h"

#include <algorithm>
#include <cmath>

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

}  // namespace lanelight::stat
