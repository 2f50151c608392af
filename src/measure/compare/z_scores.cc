#include "src/measure/compare/metrics.h"

#include <algorithm>
#include <cmath>

#include "src/base/stat/distributions.h"

namespace lanelight {

void ZCollector::Add(double difference, double variance) {
  if (!std::isfinite(variance) || variance < 0) {
    ++scores_.invalid;
  } else if (variance == 0) {
    ++(difference == 0 ? scores_.exact : scores_.mismatched);
  } else {
    z_.push_back(difference / std::sqrt(variance));
  }
}

ZScores ZCollector::Finish() {
  scores_.available = true;
  scores_.count = z_.size();
  if (z_.empty()) return scores_;
  const double n = double(z_.size());
  double sum = 0, squares = 0;
  std::uint64_t beyond_2 = 0, beyond_3 = 0;
  for (double z : z_) {
    sum += z;
    beyond_2 += std::abs(z) > 2;
    beyond_3 += std::abs(z) > 3;
  }
  scores_.mean = sum / n;
  for (double z : z_) squares += (z - scores_.mean) * (z - scores_.mean);
  scores_.standard_deviation = n > 1 ? std::sqrt(squares / (n - 1)) : 0;
  scores_.beyond_2 = double(beyond_2) / n;
  scores_.beyond_3 = double(beyond_3) / n;
  scores_.ks_distance = KsDistance();
  return scores_;
}

double ZCollector::KsDistance() {
  std::ranges::sort(z_);
  const double n = double(z_.size());
  double distance = 0;
  for (std::size_t i = 0; i < z_.size(); ++i) {
    const double cdf = stat::NormalCdf(z_[i]);
    distance = std::max({distance, cdf - i / n, (i + 1) / n - cdf});
  }
  return distance;
}

}  // namespace lanelight
