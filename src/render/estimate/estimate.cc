#include "src/render/estimate/estimate.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <vector>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/base/stat/distributions.h"
#include "src/render/films/accumulator.h"

namespace lanelight {
namespace {

constexpr int kReach = 1;           // neighbours: 3 x 3 pixels
constexpr int kVarianceReach = 2;   // where their scatter is taken from: 5 x 5
constexpr double kRounding = 1e-5;  // of a mean, at most (docs/numbers.md)
constexpr double kTwoSided = 1.96;  // kEstimateConfidence of a normal is within
constexpr int kMaxDoublings = 12;   // of the samples, looked at for an interval

// 1 / x^2 of a noisy x is too large by three times its variance over the square, to
// second order: `noise`, that variance, takes it away.
double Weight(double mean, double noise = 0) {
  return 1 / (mean * mean + 3 * noise + kRelativeEpsilon);
}

// Sums over pixels, of shares t of the error.
struct Shares {
  double sum = 0, squares = 0, by_freedom = 0;

  void Add(double fraction, double freedom, double dependents) {
    sum += fraction;
    // E[s^4] = sigma^4 (G + 1) / (G - 1) for normal observations.
    const double square = dependents * fraction * fraction * freedom / (freedom + 2);
    squares += square;
    by_freedom += square / freedom;
  }
  void Add(const Shares& other) {
    sum += other.sum;
    squares += other.squares;
    by_freedom += other.by_freedom;
  }
  double K1() const { return squares > 0 ? SquaredSum() / squares : 1; }
  double K2() const { return squares > 0 ? SquaredSum() / by_freedom : 1; }

 private:
  // Returns an estimate of (sum of true shares)^2, without the estimate's own variance.
  double SquaredSum() const { return std::max(squares, sum * sum - 2 * by_freedom); }
};

// The posterior of a channel's true value: a gamma distribution with this mean.
struct Posterior {
  double mean = 0, shape = std::numeric_limits<double>::infinity();

  // Returns the quantile at z of the standard normal (Wilson and Hilferty 1931).
  double Quantile(double z) const {
    const double root = 1 - 1 / (9 * shape) + z / (3 * std::sqrt(shape));
    return mean * root * root * root;  // the root is positive for z > -2 and shape >= 1
  }
};

struct ChannelTruth {
  Posterior own;
  double noise = 0;  // variance that the neighbours bring into its mean
  // The same with the neighbourhood's variance in place of the pixel's.
  double pooled = 0, pooled_noise = 0;
};

struct Sums {
  Shares square, relative;
  double pooled = 0;  // relative error, by ChannelTruth::pooled
  // Squares by which the relative errors may grow; the largest, and the index of its
  // pixel.
  double up_squares = 0, max_upper = 0;
  std::size_t max_upper_at = 0;
  double squares = 0,
         relative_squares = 0;  // of means, which rounding is in proportion to
  std::uint64_t pixels = 0;

  // `fraction`: of the variance that is left; `dependents`: SampleGroups.
  void Add(std::size_t index, const PixelEstimate& p,
           const std::array<ChannelTruth, 3>& truth, double fraction, double dependents) {
    double own_square = 0, own_relative = 0, up = 0;
    for (int c = 0; c < 3; ++c) {
      const double v = p.variance[c] * fraction / 3;
      const double weight = Weight(truth[c].own.Quantile(0), truth[c].noise);
      own_square += v;
      own_relative += v * weight;
      pooled += v * Weight(truth[c].pooled, truth[c].pooled_noise);
      up += v * (Weight(truth[c].own.Quantile(-kTwoSided)) - weight);
    }
    square.Add(own_square, p.freedom, dependents);
    relative.Add(own_relative, p.freedom, dependents);
    up_squares += dependents * up * up;
    for (int c = 0; c < 3; ++c) {
      const double s = p.mean[c] * p.mean[c] / 3;
      squares += s;
      relative_squares += s / (3 * s + kRelativeEpsilon);
    }
    if (up > max_upper) max_upper = up, max_upper_at = index;
    ++pixels;
  }
  void Add(const Sums& other) {
    square.Add(other.square);
    relative.Add(other.relative);
    pooled += other.pooled;
    up_squares += other.up_squares;
    squares += other.squares;
    relative_squares += other.relative_squares;
    if (other.max_upper > max_upper) {
      max_upper = other.max_upper, max_upper_at = other.max_upper_at;
    }
    pixels += other.pixels;
  }
};

// The pixels of an image, and what their neighbours say of them.
class PixelGrid {
 public:
  PixelGrid(const PixelRect& window, double dependents,
            const std::function<PixelEstimate(int, int)>& pixel,
            const std::atomic<bool>* stop)
      : width_(window.width()),
        height_(window.height()),
        dependents_(dependents),
        stop_(stop),
        pixels_(Count()),
        neighbours_(Count()) {
    ForRows([&](int y) {
      for (int x = 0; x < width_; ++x) {
        pixels_[Index(x, y)] = pixel(window.x0 + x, window.y0 + y);
      }
    });
    ForRows([&](int y) {
      for (int x = 0; x < width_; ++x) neighbours_[Index(x, y)] = MeanAround(x, y);
    });
  }

  // Sums in the order of the rows, so that the result is the same for any number of
  // threads. `fraction`: part of the variances that more samples would leave.
  Sums Total(double fraction = 1) const {
    std::vector<Sums> rows(static_cast<std::size_t>(height_));
    ForRows([&](int y) {
      Sums& row = rows[std::size_t(y)];
      for (int x = 0; x < width_; ++x) {
        const std::size_t i = Index(x, y);
        if (!pixels_[i].known) continue;
        row.Add(i, pixels_[i], Truth(x, y, fraction), fraction, dependents_);
      }
    });
    Sums total;
    for (const Sums& row : rows) total.Add(row);
    return total;
  }

  bool IsStopped() const { return stop_ != nullptr && *stop_; }

  bool IsBlack() const {
    return std::ranges::all_of(pixels_,
                               [](const PixelEstimate& p) { return p.mean == Rgb{}; });
  }

 private:
  std::size_t Count() const { return std::size_t(width_) * std::size_t(height_); }
  std::size_t Index(int x, int y) const {
    return std::size_t(y) * std::size_t(width_) + std::size_t(x);
  }
  template <class Body>
  void ForRows(const Body& body) const {
    ParallelFor(static_cast<std::size_t>(height_), [&](std::size_t y) {
      if (!IsStopped()) body(int(y));
    });
  }
  // Calls body(index) for the known pixels around (x, y), itself included.
  template <class Body>
  void ForWindow(int x, int y, int reach, const Body& body) const {
    const int x1 = std::min(width_ - 1, x + reach), y1 = std::min(height_ - 1, y + reach);
    for (int b = std::max(0, y - reach); b <= y1; ++b) {
      for (int a = std::max(0, x - reach); a <= x1; ++a) {
        if (pixels_[Index(a, b)].known) body(Index(a, b));
      }
    }
  }

  // Returns the mean of the neighbours, without the pixel; its own mean if there are
  // none.
  Rgb MeanAround(int x, int y) const {
    const std::size_t self = Index(x, y);
    Rgb sum;
    double count = 0;
    ForWindow(x, y, kReach, [&](std::size_t i) {
      if (i == self) return;
      sum += pixels_[i].mean;
      ++count;
    });
    return count > 0 ? sum / count : pixels_[self].mean;
  }

  // Statistics of the pixels around one, itself included.
  struct Surroundings {
    Rgb variance_between;  // mean of (m - n)^2 - v, 5 x 5 pixels
    Rgb mean, variance;    // sums over 3 x 3 pixels
    double pixels = 0;     // these
  };
  Surroundings Around(int x, int y) const {
    Surroundings s;
    double count = 0;
    ForWindow(x, y, kVarianceReach, [&](std::size_t i) {
      const Rgb d = pixels_[i].mean - neighbours_[i];
      s.variance_between += d * d - pixels_[i].variance;
      ++count;
    });
    s.variance_between = s.variance_between / count;
    ForWindow(x, y, kReach, [&](std::size_t i) {
      s.mean += pixels_[i].mean;
      s.variance += pixels_[i].variance;
      ++s.pixels;
    });
    return s;
  }

  // Estimates the truth by empirical Bayes, with the neighbours' mean as the prior's.
  std::array<ChannelTruth, 3> Truth(int x, int y, double fraction) const {
    const PixelEstimate& p = pixels_[Index(x, y)];
    const Surroundings s = Around(x, y);
    const double others = std::max(1.0, s.pixels - 1);
    std::array<ChannelTruth, 3> out;
    for (int c = 0; c < 3; ++c) {
      const double a = std::max(0.0, s.variance_between[c]), v = p.variance[c] * fraction;
      if (!(v > 0)) continue;
      const double n = neighbours_[Index(x, y)][c];
      const double m = std::abs(a * p.mean[c] + v * n) / (a + v);
      out[c].own.mean = m;
      if (a > 0) out[c].own.shape = std::max(1.0, m * m * (a + v) / (a * v));
      out[c].noise = std::pow(v / (a + v) / others, 2) * (s.variance[c] * fraction - v);
      const double u = s.variance[c] * fraction / s.pixels;
      out[c].pooled = (a * p.mean[c] + u * s.mean[c] / s.pixels) / (a + u);
      out[c].pooled_noise = std::pow(u / (a + u), 2) * u / s.pixels;
    }
    return out;
  }

  int width_, height_;
  double dependents_;
  const std::atomic<bool>* stop_;
  std::vector<PixelEstimate> pixels_;
  std::vector<Rgb> neighbours_;
};

// The relative error with what the correlation of variances and weights has taken away,
// and what the weights may be wrong by in the ends.
Interval WithWeights(const Interval& v, const Sums& sums) {
  if (!(v.value > 0)) return v;
  const double n = double(sums.pixels);
  const double skew = kSkewUncertainty * std::sqrt(std::min(v.value, 1.0));
  const double low = std::log(v.low / v.value);
  const double pooled = std::log(std::min(1.0, sums.pooled / sums.relative.sum));
  const double up = std::sqrt(sums.up_squares) / n;
  const double value =
      v.value * std::exp(kSkew * std::sqrt(std::min(v.value, kMaxSkewError)));
  return {value, value * std::exp(-std::hypot(low, pooled, skew)),
          value + std::hypot(v.high - v.value, up, value * skew)};
}

// Returns the interval without an upper end.
Interval AtLeast(const Interval& v) {
  return {v.value, v.low, std::numeric_limits<double>::infinity()};
}

ErrorEstimate FromSums(const Sums& sums) {
  ErrorEstimate out;
  out.pixels = sums.pixels;
  out.available = sums.pixels > 0;
  if (!out.available) return out;
  const double n = double(sums.pixels);
  const Shares &square = sums.square, &relative = sums.relative;
  out.effective_pixels = relative.sum > 0 ? relative.K1() : n;
  const Interval mse = ErrorInterval(square.sum / n, square.K1(), square.K2());
  out.rmse = {std::sqrt(mse.value), std::sqrt(mse.low), std::sqrt(mse.high)};
  out.relmse =
      WithWeights(ErrorInterval(relative.sum / n, relative.K1(), relative.K2()), sums);
  out.has_interval = mse.high <= kMaxUpperRatio * mse.value &&
                     out.relmse.high <= kMaxUpperRatio * out.relmse.value;
  // Rounding is no noise, and shows where there is none.
  constexpr double kSquare = kRounding * kRounding;
  out.relmse.high += kSquare * sums.relative_squares / n;
  out.rmse.high = std::sqrt(mse.high + kSquare * sums.squares / n);
  return out;
}

ErrorEstimate WithoutUpperBound(ErrorEstimate out, std::string why) {
  out.has_interval = false;
  out.rmse = AtLeast(out.rmse);
  out.relmse = AtLeast(out.relmse);
  out.why = std::move(why);
  return out;
}

// Tiles that are ahead must not speak for the others.
ErrorEstimate EstimateOfPartialImage(std::uint64_t known, std::uint64_t all) {
  ErrorEstimate out;
  out.pixels = known;
  out.why = fmt::format(
      "{} of {} pixels have too few samples for a variance; an error estimate needs two "
      "samples in every pixel",
      all - known, all);
  return out;
}

// Returns the factor of samples, a power of two, that would give an interval; 0 if none
// does.
int MoreSamples(const PixelGrid& grid) {
  const auto suffice = [&grid](int doublings) {
    return FromSums(grid.Total(std::ldexp(1.0, -doublings))).has_interval;
  };
  int too_few = 0, enough = kMaxDoublings + 1;
  while (enough - too_few > 1) {
    const int middle = (too_few + enough) / 2;
    (suffice(middle) ? enough : too_few) = middle;
  }
  return enough > kMaxDoublings ? 0 : 1 << enough;
}

}  // namespace

ErrorEstimate EstimateError(const PixelRect& window,
                            const std::function<PixelEstimate(int, int)>& pixel,
                            double dependents, const std::atomic<bool>* stop) {
  const PixelGrid grid(window, dependents, pixel, stop);
  const Sums sums = grid.Total();
  if (grid.IsStopped()) return {};
  if (sums.pixels > 0 && sums.pixels < window.pixels()) {
    return EstimateOfPartialImage(sums.pixels, window.pixels());
  }
  ErrorEstimate out = FromSums(sums);
  // Samples that are all black are equal, and say nothing of a lamp that they missed.
  if (out.available && grid.IsBlack()) {
    return WithoutUpperBound(std::move(out), kNoLight);
  }
  if (!out.available || out.has_interval) return out;
  const auto times = [](const Interval& v) { return v.high / v.value; };
  const double rmse = times(out.rmse), maximum = std::max(rmse * rmse, times(out.relmse));
  const int x = window.x0 + int(sums.max_upper_at) % window.width();
  const int y = window.y0 + int(sums.max_upper_at) / window.width();
  const int more = MoreSamples(grid);
  if (grid.IsStopped()) return {};
  out.why = fmt::format(
      "rare bright samples, mainly at pixel ({}, {}), may make it {:.2g} times as large; "
      "{}, or a strategy that finds them (`lanelight study`)",
      x, y, maximum,
      more > 0 ? fmt::format("an interval needs about {} times the samples", more)
               : fmt::format("an interval needs more than {} times the samples",
                             1 << kMaxDoublings));
  if (rmse * rmse > kMaxUpperRatio) out.rmse = AtLeast(out.rmse);
  if (times(out.relmse) > kMaxUpperRatio) out.relmse = AtLeast(out.relmse);
  return out;
}

ErrorEstimate EstimateError(const FilmAccumulator& film, const std::atomic<bool>* stop) {
  const auto pixel = [&film](int x, int y) {
    PixelEstimate p;
    p.known = film.HasVariance(x, y);
    if (!p.known) return p;
    p.mean = film.Mean(x, y);
    p.variance = film.Variance(x, y);
    p.freedom = double(film.Observations(x, y) - 1);
    return p;
  };
  ErrorEstimate out =
      EstimateError(WindowOf(film), pixel, film.groups().dependents, stop);
  // The expected number of samples that have met a light.
  const double met = TotalSamples(film) * film.chance_of_light();
  if (!out.has_interval || film.chance_of_light() >= 1 || met >= kMinExpectedMeetings)
    return out;
  return WithoutUpperBound(
      std::move(out),
      fmt::format("only {:.2g} samples hit lamps by chance, so some lamps may "
                  "be missing: an interval needs {:.2g} times as many samples, "
                  "or directions=mis, which samples lights",
                  met, kMinExpectedMeetings / met));
}

Interval ErrorInterval(double estimate, double k1, double k2) {
  LL_CHECK_GE(estimate, 0.0);
  if (estimate == 0) return {0, 0, 0};
  constexpr double kTail = (1 - kEstimateConfidence) / 2;
  // Beyond these bounds nothing is left to widen, and FQuantile has its range.
  k1 = std::clamp(k1, 1.0, 1e9);
  k2 = std::clamp(k2, 1.0, 1e9);
  // The median of F is near 1, so the ends are on either side of the estimate.
  return {estimate, estimate * std::min(1.0, stat::FQuantile(kTail, k1, k2)),
          estimate * std::max(1.0, stat::FQuantile(1 - kTail, k1, k2))};
}

}  // namespace lanelight
