// Counts how often the error intervals that renders state hold.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "src/base/stat/interval.h"

namespace lanelight::bench {

/// True errors closer than this to an end count as inside: images without noise, whose
/// errors are rounded floats.
inline constexpr double kRounding = 1e-12;

/// One kind of error of some renders, stated and true.
class Coverage {
 public:
  /// `stated` without an upper end is a refusal: only its lower end is checked.
  void Add(double true_error, const Interval& stated);
  void Add(const Coverage& other);

  /// "| renders | printed | held | share | refused |", the middle of a table's row.
  std::string Cells() const;

  std::uint64_t renders() const { return printed_ + refused_; }
  /// Mean true error.
  double MeanTruth() const { return truth_ / double(renders()); }
  /// Share of the intervals with both ends that held.
  Interval Inside() const;
  /// Share refused, intervals that held with the interval of this share, numbers of true
  /// errors below and above, lower ends of refusals that held.
  std::string Counts() const;
  /// True error over estimate, half the logarithm of high over low (a mean), estimate (a
  /// mean), `own_error` of the reference over the true one.
  std::string Sizes(double own_error) const;
  /// "95.2 % [94.1, 96.2] of 1234 printed intervals held; 10 of 1244 renders ..."
  std::string Sentence(const std::string& error) const;

  static std::string CountsHead();
  static std::string SizesHead();

 private:
  std::uint64_t printed_ = 0, inside_ = 0, below_ = 0;
  std::uint64_t refused_ = 0, refused_covered_ = 0;
  double truth_ = 0, estimate_ = 0, width_ = 0;
};

/// Both kinds.
struct ErrorCoverage {
  Coverage relmse, rmse;

  void Add(const ErrorCoverage& other) {
    relmse.Add(other.relmse);
    rmse.Add(other.rmse);
  }
};

/// Totals by name, in the order in which names came first.
class Totals {
 public:
  void Add(const std::string& name, const ErrorCoverage& coverage);
  void Print(const std::string& title) const;
  /// A short table as documents have it: intervals of relmse.
  void PrintTable(const std::string& title) const;

 private:
  std::vector<std::pair<std::string, ErrorCoverage>> rows_;
};

/// Two lines, one of each kind.
void PrintCounts(const std::string& name, const ErrorCoverage& coverage);

}  // namespace lanelight::bench
