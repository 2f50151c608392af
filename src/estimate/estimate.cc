#include "src/estimate/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/stat/distributions.h"

namespace lanelight {
namespace {

constexpr int kReach = 1;   // neighbours: 3 x 3 pixels
constexpr int kSpread = 2;  // where their scatter is taken from: 5 x 5

double Weight(double mean) { return 1 / (mean * mean + kRelativeEpsilon); }

// Sums over pixels, of shares t of the error.
struct Shares {
  double sum = 0, squares = 0, by_freedom = 0;

  void Add(double share, double freedom) {
    sum += share;
    // E[s^4] = sigma^4 (G + 1) / (G - 1) for normal observations.
    const double square = share * share * freedom / (freedom + 2);
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
  // Of (sum of true shares)^2: the estimate's own variance is taken off.
  double SquaredSum() const { return std::max(squares, sum * sum - 2 * by_freedom); }
};

// What is known of a pixel's true value.
struct Posterior {
  Rgb mean, variance;
};

struct Sums {
  Shares square, relative;
  double plain = 0;   // relative error, divided by the means as they are
  double darker = 0;  // by how much it would grow if pixels were darker
  std::uint64_t pixels = 0;

  void Add(const PixelEstimate& p, const Posterior& truth) {
    double own_square = 0, own_relative = 0;
    for (int c = 0; c < 3; ++c) {
      const double v = p.variance[c];
      own_square += v / 3;
      const double weight = Weight(truth.mean[c]);
      own_relative += v * weight / 3;
      const double low =
          std::max(0.0, std::abs(truth.mean[c]) - std::sqrt(truth.variance[c]));
      darker += std::min(kMostDarker, v * (Weight(low) - weight)) / 3;
      plain += v * Weight(p.mean[c]) / 3;
    }
    square.Add(own_square, p.freedom);
    relative.Add(own_relative, p.freedom);
    ++pixels;
  }
  void Add(const Sums& other) {
    square.Add(other.square);
    relative.Add(other.relative);
    plain += other.plain;
    darker += other.darker;
    pixels += other.pixels;
  }
};

// The pixels of an image, and what their neighbours say of them.
class PixelGrid {
 public:
  PixelGrid(int width, int height, const std::function<PixelEstimate(int, int)>& pixel)
      : width_(width), height_(height), pixels_(Count()), neighbours_(Count()) {
    ForRows([&](int y) {
      for (int x = 0; x < width_; ++x) pixels_[Index(x, y)] = pixel(x, y);
    });
    ForRows([&](int y) {
      for (int x = 0; x < width_; ++x) neighbours_[Index(x, y)] = MeanAround(x, y);
    });
  }

  // In the order of the rows, so that it is the same for any number of threads.
  Sums Total() const {
    std::vector<Sums> rows(static_cast<std::size_t>(height_));
    ForRows([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const PixelEstimate& p = pixels_[Index(x, y)];
        if (p.known) rows[static_cast<std::size_t>(y)].Add(p, Shrunk(x, y));
      }
    });
    Sums total;
    for (const Sums& row : rows) total.Add(row);
    return total;
  }

 private:
  std::size_t Count() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  template <class Body>
  void ForRows(const Body& body) const {
    ParallelFor(static_cast<std::size_t>(height_),
                [&](std::size_t y) { body(static_cast<int>(y)); });
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

  // Without the pixel itself; its own mean if it stands alone.
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

  Posterior Shrunk(int x, int y) const {
    const PixelEstimate& p = pixels_[Index(x, y)];
    const Rgb& around = neighbours_[Index(x, y)];
    Rgb spread;
    double count = 0;
    ForWindow(x, y, kSpread, [&](std::size_t i) {
      for (int c = 0; c < 3; ++c) {
        const double d = pixels_[i].mean[c] - neighbours_[i][c];
        spread[c] += d * d - pixels_[i].variance[c];
      }
      ++count;
    });
    Posterior out;
    for (int c = 0; c < 3; ++c) {
      const double v = p.variance[c], a = std::max(0.0, spread[c] / count);
      out.mean[c] = v > 0 ? (a * p.mean[c] + v * around[c]) / (a + v) : p.mean[c];
      out.variance[c] = v > 0 ? v * a / (a + v) : 0;
    }
    return out;
  }

  int width_, height_;
  std::vector<PixelEstimate> pixels_;
  std::vector<Rgb> neighbours_;
};

Interval SquareRoot(const Interval& v) {
  return {std::sqrt(v.value), std::sqrt(v.low), std::sqrt(v.high)};
}

// What the choice of the weights may be wrong by, as a half width in log(relmse).
double WeightDoubt(const Sums& sums, double relmse) {
  const double shrunk = sums.relative.sum;
  if (!(shrunk > 0) || !(sums.plain > 0)) return 0;
  return std::hypot(kWeightDoubt * std::log(shrunk / sums.plain),
                    kSkewDoubt * std::sqrt(std::min(relmse, 1.0)), kLeastDoubt);
}

// What the correlation of variances and weights has taken away.
double SkewFactor(double relmse) {
  return std::exp(kSkew * std::sqrt(std::min(relmse, 1.0)));
}

// Why an error has no upper end; empty if it has one.
std::string TooFew(const Shares& shares, double pixels) {
  if (!(shares.sum > 0) || shares.K1() >= std::min(kLeastEffectivePixels, pixels / 2)) {
    return "";
  }
  return fmt::format("few pixels carry it (as {:.2g} of {} alike would): rare samples",
                     shares.K1(), pixels);
}
std::string TooDark(const Sums& sums) {
  const double change = sums.relative.sum / sums.plain;
  if (sums.plain > 0 && std::abs(std::log(change)) > kMostWeightChange) {
    return fmt::format(
        "it is {:.2g} times as large by what neighbours say of noisy pixels: "
        "rare bright samples",
        change);
  }
  if (!(sums.darker > kMostDoubt * sums.relative.sum)) return "";
  return fmt::format(
      "it would be {:.0f} % larger if noisy pixels were darker by as much as their noise "
      "allows: rare bright samples",
      100 * sums.darker / sums.relative.sum);
}

// Only the lower end of an interval is known.
Interval AtLeast(const Interval& v) {
  return {v.value, v.low, std::numeric_limits<double>::infinity()};
}

}  // namespace

Interval ErrorInterval(double estimate, double k1, double k2, double doubt) {
  LL_CHECK_GE(estimate, 0.0);
  if (estimate == 0) return {0, 0, 0};
  constexpr double kTail = (1 - kEstimateConfidence) / 2;
  // Beyond these bounds nothing is left to widen, and FQuantile has its range.
  k1 = std::clamp(k1, 1.0, 1e9);
  k2 = std::clamp(k2, 1.0, 1e9);
  const double low = std::log(stat::FQuantile(kTail, k1, k2));
  const double high = std::log(stat::FQuantile(1 - kTail, k1, k2));
  // The median of F is near 1, so both logarithms have their expected sign.
  return {estimate, estimate * std::exp(-std::hypot(std::min(low, 0.0), doubt)),
          estimate * std::exp(std::hypot(std::max(high, 0.0), doubt))};
}

ErrorEstimate EstimateError(int width, int height,
                            const std::function<PixelEstimate(int, int)>& pixel) {
  const Sums sums = PixelGrid(width, height, pixel).Total();
  ErrorEstimate out;
  out.pixels = sums.pixels;
  out.available = sums.pixels > 0;
  if (!out.available) return out;
  const double n = static_cast<double>(sums.pixels);
  out.effective_pixels = sums.relative.sum > 0 ? sums.relative.K1() : n;
  out.rmse =
      SquareRoot(ErrorInterval(sums.square.sum / n, sums.square.K1(), sums.square.K2()));
  const double relmse = sums.relative.sum / n, doubt = WeightDoubt(sums, relmse);
  const auto interval = [&](double value) {
    return ErrorInterval(value, sums.relative.K1(), sums.relative.K2(), doubt);
  };
  out.why = TooFew(sums.relative, n);
  if (out.why.empty()) out.why = TooDark(sums);
  // The skewness of what has not been sampled well is not known either.
  out.relmse =
      out.why.empty() ? interval(relmse * SkewFactor(relmse)) : AtLeast(interval(relmse));
  const std::string why = TooFew(sums.square, n);
  if (!why.empty()) out.rmse = AtLeast(out.rmse);
  if (out.why.empty()) out.why = why;
  out.has_interval = out.why.empty();
  return out;
}

ErrorEstimate EstimateError(const FilmAccumulator& film) {
  return EstimateError(film.width(), film.height(), [&film](int x, int y) {
    const int px = film.x0() + x, py = film.y0() + y;
    PixelEstimate p;
    p.known = film.HasVariance(px, py);
    if (!p.known) return p;
    p.mean = film.Mean(px, py);
    p.variance = film.Variance(px, py);
    p.freedom = static_cast<double>(film.Observations(px, py) - 1);
    return p;
  });
}

}  // namespace lanelight
