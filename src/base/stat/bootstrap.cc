#include "src/base/stat/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/core/check.h"
#include "src/base/stat/distributions.h"

namespace lanelight::stat {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The tail of 1 % behind the widening holds 20 of 2000 resamples: a quantile known within
// some 10 % of its distance from the centre.
constexpr std::size_t kMinRepetitions = 8;
constexpr double kFinestTail = 0.01;
constexpr int kResamples = 2000;
// Beyond this the bootstrap's quantile is an artefact of ties (a resample without the one
// repetition that differs has no spread at all).
constexpr double kMaxWidening = 3;

// SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number
// generators"): the n-th number is a mix of n times a constant.
class Counter {
 public:
  // Uniform in [0, n), biased by less than n / 2^32.
  std::size_t Below(std::size_t n) {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return static_cast<std::size_t>(((z >> 32) * n) >> 32);
  }

 private:
  std::uint64_t state_ = 0;
};

struct Estimate {
  double value = 0, error = 0;  // error: the jackknife's
};

class Jackknife {
 public:
  Jackknife(const Repetitions& repetitions, const OfMeans& f)
      : repetitions_(repetitions),
        f_(f),
        sums_(repetitions.columns()),
        means_(repetitions.columns()),
        values_(repetitions.size()) {}

  Estimate operator()(std::span<const std::size_t> indices) {
    std::fill(sums_.begin(), sums_.end(), 0.0);
    for (std::size_t i : indices) {
      for (std::size_t c = 0; c < sums_.size(); ++c) sums_[c] += repetitions_[i][c];
    }
    const double n = static_cast<double>(indices.size());
    double mean = 0;
    for (std::size_t k = 0; k < indices.size(); ++k) {
      values_[k] = Value(repetitions_[indices[k]].data(), n - 1);
      mean += values_[k] / n;
    }
    double squares = 0;
    for (double v : values_) squares += (v - mean) * (v - mean);
    return {Value(nullptr, n), std::sqrt(squares * (n - 1) / n)};
  }

 private:
  // Returns f at the means of `count` repetitions, without one.
  double Value(const double* left_out, double count) {
    for (std::size_t c = 0; c < sums_.size(); ++c) {
      means_[c] = (sums_[c] - (left_out ? left_out[c] : 0)) / count;
    }
    return f_(means_);
  }

  const Repetitions& repetitions_;
  const OfMeans& f_;
  std::vector<double> sums_, means_, values_;
};

// Differences below this are rounding.
double Rounding(double value) { return 1e-12 * (1 + std::abs(value)); }

// |t| of a resample: how many of its own standard errors it lies off the whole sample.
double Studentised(const Estimate& resample, double value) {
  const double distance = std::abs(resample.value - value);
  if (distance <= Rounding(value)) return 0;
  return distance <= kInfinity && resample.error > Rounding(value)
             ? distance / resample.error
             : kInfinity;
}

// Ratio of the bootstrap's quantile to Student's, at least 1.
double Widening(Jackknife& jackknife, std::size_t n, double value, double tail) {
  std::vector<std::size_t> indices(n);
  std::vector<double> t;
  Counter counter;
  for (int b = 0; b < kResamples; ++b) {
    for (std::size_t& i : indices) i = counter.Below(n);
    t.push_back(Studentised(jackknife(indices), value));
  }
  const auto at = t.begin() + static_cast<std::ptrdiff_t>((1 - tail) * kResamples);
  std::nth_element(t.begin(), at, t.end());
  return std::clamp(*at / StudentTwoSidedQuantile(tail, static_cast<double>(n) - 1), 1.0,
                    kMaxWidening);
}

}  // namespace

void Repetitions::Add(std::span<const double> row) {
  LL_CHECK_EQ(row.size(), columns_);
  values_.insert(values_.end(), row.begin(), row.end());
}

double HalfWidth(const Repetitions& repetitions, const OfMeans& f, double confidence) {
  LL_CHECK(confidence > 0 && confidence < 1);
  const std::size_t n = repetitions.size();
  if (n < 2) return kInfinity;
  Jackknife jackknife(repetitions, f);
  std::vector<std::size_t> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = i;
  const Estimate whole = jackknife(all);
  if (!std::isfinite(whole.value) || !std::isfinite(whole.error)) return kInfinity;
  if (whole.error <= Rounding(whole.value)) return 0;
  const double tail = 1 - confidence;
  double factor = StudentTwoSidedQuantile(tail, static_cast<double>(n) - 1);
  if (n >= kMinRepetitions) {
    factor *= Widening(jackknife, n, whole.value, std::max(tail, kFinestTail));
  }
  return factor * whole.error;
}

}  // namespace lanelight::stat
