// Two measurements of throughput, of two programs or two machines: which rows are faster.
#pragma once

#include <string>
#include <vector>

#include "src/measure/throughput/throughput_json.h"

namespace lanelight {

struct RateRatio {
  std::string row;     // KnownRow::Key()
  Interval ratio;      // rate of the new one over that of the old
  Interval cpu_ratio;  // the same of rates per second of processor time

  /// Slower by more than `tolerance`, beyond doubt.
  bool Regresses(double tolerance) const {
    return ratio.value < 1 - tolerance && ratio.high < 1;
  }
};

struct RateComparison {
  std::vector<RateRatio> rows;  // of both
  std::vector<std::string> only_in_one;
  /// Rows of scenes in both that differ in samples, size, threads, target or strategy
  /// from all rows of the other: a sentence each.
  std::vector<std::string> refused;
  /// Why either machine was too busy for a comparison; empty if neither was.
  std::vector<std::string> busy;

  enum class Verdict { kNotSlower, kSlower, kNotComparable };
  /// Not comparable: either machine was busy, or a row was refused and no other is
  /// slower.
  Verdict Judge(double tolerance) const;
  /// Geometric mean of the ratios; 1 without rows.
  double Mean() const;
};

/// Ratio of two independent rates: half widths of their logarithms add as their squares.
Interval RateRatioOf(const Interval& now, const Interval& before);

RateComparison CompareRates(const KnownThroughput& before, const KnownThroughput& now);

}  // namespace lanelight
