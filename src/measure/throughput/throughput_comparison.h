// Writes measured throughput as JSON, compares two measurements, and lists many.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/measure/throughput/throughput.h"

namespace lanelight {

/// Version of the JSON. Increases when a member changes its meaning or is removed.
inline constexpr int kBenchSchema = 1;

/// Writes machine, program, and all rows with the seconds of their repeats;
/// docs/bench.md. `within`: ThroughputOptions::within.
nlohmann::json ToJson(const std::vector<ThroughputRow>& rows, double within);

/// The members of a row that a comparison reads.
struct KnownRow {
  std::string scene, target, strategy;
  int threads = 0, width = 0, height = 0;
  std::uint64_t spp = 0;
  Interval rate, cpu_rate;        // samples per second, and per second of processor time
  std::string scene_hash, label;  // SceneLabel()

  /// Returns whether both rows render the same scene file with the same size, samples per
  /// pixel and strategy, on any machine.
  bool SameWork(const KnownRow& other) const;

  /// Returns a text that is equal for rows that can be compared. It has those parts of
  /// the strategy that differ from the default.
  std::string Key() const;
};
struct KnownThroughput {
  std::string machine, program;
  std::vector<std::string> busy;  // BusyReasons()
  std::vector<KnownRow> rows;
  std::string date, name;  // UTC; the file without folder and extension
};

/// Reads JSON written by ToJson(). Throws InputError.
KnownThroughput ReadThroughput(const std::string& path);
KnownThroughput ThroughputFromJson(const nlohmann::json& json);
/// Returns the results in a folder, newest first; or those that are part of the program,
/// with that of a file. `place` may be empty: the latter alone. Throws InputError.
std::vector<KnownThroughput> ListedResults(const std::string& place);

/// Probability that a comparison of equal programs reports any slower row.
inline constexpr double kFalseAlarms = 0.001;
/// Default of `bench --tolerance`.
inline constexpr double kTolerance = 0.02;

struct RateRatio {
  std::string row;     // KnownRow::Key()
  Interval ratio;      // new rate divided by old rate
  Interval cpu_ratio;  // the same for rates per second of processor time
  /// The ratio that is judged: `ratio`. If a machine was busy, cpu_ratio without the
  /// slowdown that other programs explain, kBusySlowdown.
  Interval judged;
  double high = 0;  // upper limit of `judged`; kFalseAlarms of it holds for all rows

  /// Returns whether the new rate is significantly lower, by more than `tolerance`.
  bool Regresses(double tolerance) const {
    return judged.value < 1 - tolerance && high < 1;
  }
};

struct RateComparison {
  std::vector<RateRatio> rows;  // in both measurements
  std::vector<std::string> only_in_one;
  /// Rows whose scene is in both measurements, but not with the same samples, size,
  /// threads, target and strategy; one sentence each.
  std::vector<std::string> refused;
  /// Reasons why other programs may have changed the rates.
  std::vector<std::string> busy;

  enum class Verdict { kNotSlower, kSlower, kNotComparable };
  /// Returns kNotComparable if no row is slower, and a row was refused, or a machine was
  /// so busy that Detectable() exceeds kMaxDetectable.
  Verdict Judge(double tolerance) const;
  /// Returns the fraction by which all rows must lose speed to be reported.
  double Detectable(double tolerance) const;
};

/// Returns the ratio of two independent rates: squares of half widths of their logarithms
/// add.
Interval RateRatioOf(const Interval& now, const Interval& before);

/// Returns the geometric mean of independent values; 1 without values. Half widths of
/// logarithms add as squares.
Interval GeometricMean(const std::vector<Interval>& values);

RateComparison CompareRates(const KnownThroughput& before, const KnownThroughput& now);

/// Returns a table of ratios and a sentence on rows slower by more than `tolerance`, in
/// lines of at most `width` columns.
std::string ComparisonText(const RateComparison& comparison,
                           const KnownThroughput& before, double tolerance,
                           std::size_t width);

/// Returns a table of the results beside each other: rates by scene, and ratios to the
/// result of that index, in lines of at most `width` columns.
std::string ListText(const std::vector<KnownThroughput>& results, std::size_t reference,
                     std::size_t width);

}  // namespace lanelight
