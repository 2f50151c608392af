#include "src/measure/throughput/throughput_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace lanelight {
Interval RateRatioOf(const Interval& now, const Interval& before) {
  const double ratio = now.value / before.value;
  const double below =
      std::hypot(std::log(now.value / now.low), std::log(before.high / before.value));
  const double above =
      std::hypot(std::log(now.high / now.value), std::log(before.value / before.low));
  return {ratio, ratio * std::exp(-below), ratio * std::exp(above)};
}

namespace {

// Keys of the rows that the other has of the same scene; empty without one.
std::string OfSameScene(const KnownRow& row, const KnownThroughput& other) {
  std::string keys;
  for (const KnownRow& candidate : other.rows) {
    if (candidate.scene != row.scene) continue;
    keys += (keys.empty() ? "" : "; ") + candidate.Key();
  }
  return keys;
}

void AddBusy(const KnownThroughput& known, const char* when, RateComparison& comparison) {
  for (const std::string& reason : known.busy) {
    comparison.busy.push_back(fmt::format("{}, {}", when, reason));
  }
}

}  // namespace

RateComparison CompareRates(const KnownThroughput& before, const KnownThroughput& now) {
  std::map<std::string, const KnownRow*> old;
  for (const KnownRow& row : before.rows) old[row.Key()] = &row;
  RateComparison comparison;
  AddBusy(before, "before", comparison);
  AddBusy(now, "now", comparison);
  for (const KnownRow& row : now.rows) {
    const auto found = old.find(row.Key());
    if (found != old.end()) {
      const KnownRow& other = *found->second;
      comparison.rows.push_back({row.Key(), RateRatioOf(row.rate, other.rate),
                                 RateRatioOf(row.cpu_rate, other.cpu_rate)});
      old.erase(found);
      continue;
    }
    const std::string others = OfSameScene(row, before);
    if (others.empty()) {
      comparison.only_in_one.push_back(row.Key());
    } else {
      comparison.refused.push_back(fmt::format("{} (before: {})", row.Key(), others));
    }
  }
  for (const auto& [key, unused] : old) comparison.only_in_one.push_back(key);
  return comparison;
}

RateComparison::Verdict RateComparison::Judge(double tolerance) const {
  if (!busy.empty()) return Verdict::kNotComparable;
  for (const RateRatio& row : rows) {
    if (row.Regresses(tolerance)) return Verdict::kSlower;
  }
  return refused.empty() && !rows.empty() ? Verdict::kNotSlower : Verdict::kNotComparable;
}

double RateComparison::Mean() const {
  double sum = 0;
  for (const RateRatio& row : rows) sum += std::log(row.ratio.value);
  return rows.empty() ? 1 : std::exp(sum / double(rows.size()));
}

}  // namespace lanelight
