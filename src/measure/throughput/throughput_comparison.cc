#include "src/measure/throughput/throughput_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "src/base/core/text_layout.h"
#include "src/base/stat/distributions.h"

namespace lanelight {

Interval RateRatioOf(const Interval& now, const Interval& before) {
  const double ratio = now.value / before.value;
  const double below =
      std::hypot(std::log(now.value / now.low), std::log(before.high / before.value));
  const double above =
      std::hypot(std::log(now.high / now.value), std::log(before.value / before.low));
  return {ratio, ratio * std::exp(-below), ratio * std::exp(above)};
}

Interval GeometricMean(const std::vector<Interval>& values) {
  double sum = 0, below = 0, above = 0;
  for (const Interval& v : values) {
    sum += std::log(v.value);
    below = std::hypot(below, std::log(v.value / v.low));
    above = std::hypot(above, std::log(v.high / v.value));
  }
  const double n = std::max<double>(1, double(values.size()));
  const double mean = std::exp(sum / n);
  return {mean, mean * std::exp(-below / n), mean * std::exp(above / n)};
}

namespace {

// Returns the ratio of rates per processor second without the slowdown that other
// programs explain.
Interval WithoutOthers(const Interval& cpu_ratio) {
  const double margin = 1 + kBusySlowdown;
  return {margin * cpu_ratio.value, margin * cpu_ratio.low, margin * cpu_ratio.high};
}

// Half widths of medians of 6 to 20 repeats scatter. Simulated comparisons of equal
// programs need about the quantiles of so many degrees of freedom.
constexpr double kDegreesOfFreedom = 12;

// Widens the upper limits of single rows to limits that hold for all rows together.
void SetUpperLimits(std::vector<RateRatio>& rows) {
  if (rows.empty()) return;
  const auto quantile = [](double one_sided) {
    return stat::StudentTwoSidedQuantile(2 * one_sided, kDegreesOfFreedom);
  };
  const double wider =
      quantile(kFalseAlarms / double(rows.size())) / quantile((1 - kBenchConfidence) / 2);
  for (RateRatio& row : rows) {
    const Interval& ratio = row.judged;
    row.high = ratio.value * std::pow(ratio.high / ratio.value, wider);
  }
}

// Returns the keys of rows of `other` with the same scene; empty without one.
std::string OfSameScene(const KnownRow& row, const KnownThroughput& other) {
  std::string keys;
  for (const KnownRow& candidate : other.rows) {
    if (candidate.scene != row.scene) continue;
    keys += (keys.empty() ? "" : "; ") + candidate.Key();
    if (candidate.Key() == row.Key()) keys += ", another scene file";
  }
  return keys;
}

void AddBusy(const KnownThroughput& known, const char* when, RateComparison& comparison) {
  for (const std::string& reason : known.busy) {
    comparison.busy.push_back(fmt::format("{}: {}", when, reason));
  }
}

constexpr std::size_t kRowIndent = 8;

std::string IntervalText(const Interval& ratio) {
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", ratio.value, ratio.low, ratio.high);
}

std::string VerdictText(const RateComparison& comparison, double tolerance) {
  std::vector<Interval> ratios;
  const bool busy = !comparison.busy.empty();
  const std::string reasons = fmt::format("{}", fmt::join(comparison.busy, "; "));
  for (const RateRatio& row : comparison.rows) {
    ratios.push_back(busy ? row.cpu_ratio : row.ratio);
  }
  const std::string fast =
      comparison.rows.empty()
          ? ""
          : fmt::format("{:.3g} times as fast{} (geometric mean of {}); ",
                        GeometricMean(ratios).value, busy ? " per processor second" : "",
                        comparison.rows.size());
  const std::string judged =
      busy ? fmt::format(
                 ". Judged per processor second, of which other programs explain "
                 "a loss of {:.0f} %, since the machine was busy ({}).",
                 100 * kBusySlowdown, reasons)
           : ".";
  const double detectable = 100 * comparison.Detectable(tolerance);
  std::string slower;
  for (const RateRatio& row : comparison.rows) {
    if (row.Regresses(tolerance)) slower += (slower.empty() ? "" : "; ") + row.row;
  }
  switch (comparison.Judge(tolerance)) {
    case RateComparison::Verdict::kSlower:
      return fast + "slower: " + slower + judged;
    case RateComparison::Verdict::kNotSlower:
      return fast + fmt::format("no row is slower by more than {:.3g} %{}",
                                busy ? detectable : 100 * tolerance, judged);
    case RateComparison::Verdict::kNotComparable:
      break;
  }
  std::string why;
  if (!comparison.refused.empty()) {
    why = "rows differ in scene file, samples, size, threads, target or strategy";
  } else if (comparison.rows.empty()) {
    why = "no row is in both measurements";
  } else {
    why = fmt::format("{}; only a slowdown by more than {:.0f} % could have been found",
                      reasons, detectable);
  }
  return "not comparable; " + why + ".";
}

}  // namespace

RateComparison CompareRates(const KnownThroughput& before, const KnownThroughput& now) {
  std::map<std::string, const KnownRow*> old;
  for (const KnownRow& row : before.rows) old[row.Key()] = &row;
  RateComparison comparison;
  AddBusy(before, "earlier run", comparison);
  AddBusy(now, "this run", comparison);
  for (const KnownRow& row : now.rows) {
    const auto found = old.find(row.Key());
    if (found != old.end() && found->second->scene_hash == row.scene_hash) {
      const KnownRow& other = *found->second;
      comparison.rows.push_back({row.Key(),
                                 RateRatioOf(row.rate, other.rate),
                                 RateRatioOf(row.cpu_rate, other.cpu_rate),
                                 {},
                                 0});
      RateRatio& ratio = comparison.rows.back();
      ratio.judged =
          comparison.busy.empty() ? ratio.ratio : WithoutOthers(ratio.cpu_ratio);
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
  SetUpperLimits(comparison.rows);
  return comparison;
}

RateComparison::Verdict RateComparison::Judge(double tolerance) const {
  for (const RateRatio& row : rows) {
    if (row.Regresses(tolerance)) return Verdict::kSlower;
  }
  if (!refused.empty() || rows.empty()) return Verdict::kNotComparable;
  return busy.empty() || Detectable(tolerance) <= kMaxDetectable
             ? Verdict::kNotSlower
             : Verdict::kNotComparable;
}

double RateComparison::Detectable(double tolerance) const {
  const double margin = busy.empty() ? 0 : kBusySlowdown;
  double most = 0;
  for (const RateRatio& row : rows) {
    const double found = std::min(1 - tolerance, row.judged.value / row.high);
    most = std::max(most, 1 - found / (1 + margin));
  }
  return most;
}

std::string ComparisonText(const RateComparison& comparison,
                           const KnownThroughput& before, double tolerance,
                           std::size_t width) {
  std::string text = LabelledRow("against", before.machine, width, kRowIndent) +
                     LabelledRow("", before.program, width, kRowIndent) + "\n";
  const auto line = [width](const std::string& words) {
    return Wrapped(words, width, kRowIndent) + "\n";
  };
  if (!comparison.rows.empty()) {
    std::vector<std::vector<std::string>> lines = {
        {"ratio of rates", "per wall second", "per processor second"}};
    const bool slow = comparison.Judge(tolerance) == RateComparison::Verdict::kSlower;
    for (const RateRatio& row : comparison.rows) {
      lines.push_back({row.row, IntervalText(row.ratio), IntervalText(row.cpu_ratio)});
      if (slow) lines.back().push_back(row.Regresses(tolerance) ? "SLOWER" : "");
    }
    if (slow) lines.front().push_back("");
    text += TextTable(lines, {width, 1, std::size_t{slow}});
  }
  for (const std::string& row : comparison.refused) text += line("refused: " + row);
  for (const std::string& row : comparison.only_in_one) {
    text += line("only in one measurement: " + row);
  }
  return text + "\n" + Wrapped(VerdictText(comparison, tolerance), width) + "\n" +
         Wrapped(
             "Intervals cover the scatter of each run's repeats, not the influence of "
             "other programs.",
             width) +
         "\n";
}

}  // namespace lanelight
