#include "src/throughput/throughput_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace lanelight {
Interval RateRatioOf(const Interval& now, const Interval& before) {
  const double ratio = now.value / before.value;
  const double below =
      std::hypot(std::log(now.value / now.low), std::log(before.high / before.value));
  const double above =
      std::hypot(std::log(now.high / now.value), std::log(before.value / before.low));
  return {ratio, ratio * std::exp(-below), ratio * std::exp(above)};
}

RateComparison CompareRates(const KnownThroughput& before, const KnownThroughput& now) {
  std::map<std::string, Interval> old;
  for (const KnownRow& row : before.rows) old[row.Key()] = row.rate;
  RateComparison comparison;
  for (const KnownRow& row : now.rows) {
    const auto found = old.find(row.Key());
    if (found == old.end()) {
      comparison.only_in_one.push_back(row.Key());
      continue;
    }
    comparison.rows.push_back({row.Key(), RateRatioOf(row.rate, found->second)});
    old.erase(found);
  }
  for (const auto& [key, unused] : old) comparison.only_in_one.push_back(key);
  return comparison;
}

double RateComparison::Mean() const {
  double sum = 0;
  for (const RateRatio& row : rows) sum += std::log(row.ratio.value);
  return rows.empty() ? 1 : std::exp(sum / double(rows.size()));
}

}  // namespace lanelight
