// Confidence intervals of smooth functions of means (a logarithm of a ratio, say) from
// few repetitions.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace lanelight::stat {

/// Repetitions as rows of equally many quantities that were measured together.
class Repetitions {
 public:
  explicit Repetitions(std::size_t columns) : columns_(columns) {}

  void Add(std::span<const double> row);
  std::size_t size() const { return values_.size() / columns_; }
  std::size_t columns() const { return columns_; }
  std::span<const double> operator[](std::size_t i) const {
    return {values_.data() + i * columns_, columns_};
  }

 private:
  std::size_t columns_;
  std::vector<double> values_;
};

/// The function of the means of the columns; not finite where it is not defined.
using OfMeans = std::function<double(std::span<const double> means)>;

/// Half the width of the confidence interval of `f` at the true means, symmetric about f
/// at the measured ones; infinite if it is not known: fewer than two repetitions, or `f`
/// is undefined when one of them is left out. `confidence` in (0, 1).
///
/// Returns the half width of a confidence interval. The standard error is the jackknife's
/// (Tukey 1958), which sees the effect of one dominating repetition on a logarithm; the
/// delta method does not. Its factor is Student's quantile with n - 1 degrees of freedom.
/// The symmetric studentised bootstrap (Hall 1988, "On symmetric bootstrap confidence
/// intervals") widens it for skewed repetitions. Below 8 repetitions, which have too few
/// resamples, Student's t stands alone. Above a confidence of 0.99 the factor is that of
/// 0.99. Repetitions without variance: 0. Deterministic. Takes about n + 2000 n
/// evaluations of `f` (n below 8 repetitions).
double HalfWidth(const Repetitions& repetitions, const OfMeans& f, double confidence);

}  // namespace lanelight::stat
