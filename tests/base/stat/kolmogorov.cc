#include "tests/base/stat/kolmogorov.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"

namespace lanelight::stat {

double KolmogorovSurvival(double d, int n) {
  LL_CHECK_GE(n, 1);
  const double root = std::sqrt(static_cast<double>(n));
  const double lambda = (root + 0.12 + 0.11 / root) * d;
  if (lambda < 0.2) return 1;  // the survival differs from 1 by less than 1e-12
  double sum = 0;
  for (int k = 1; k <= 100; ++k) {
    const double term = std::exp(-2.0 * k * k * lambda * lambda);
    sum += k % 2 == 1 ? term : -term;
    if (term < 1e-17) break;
  }
  return std::min(1.0, std::max(0.0, 2 * sum));
}

double KsUniformPValue(std::vector<double> values) {
  LL_CHECK(!values.empty());
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  double d = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double below = static_cast<double>(i) / n;
    d = std::max({d, values[i] - below, below + 1 / n - values[i]});
  }
  return KolmogorovSurvival(d, static_cast<int>(values.size()));
}

}  // namespace lanelight::stat
