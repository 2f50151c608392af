#include "src/measure/sweep/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/base/core/check.h"
#include "src/base/stat/convergence.h"
#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"
#include "src/base/stat/relative_error.h"
#include "src/measure/compare/metrics.h"

namespace lanelight {
namespace {

constexpr double kConfidence = 0.95;  // of all tests of a curve together
// Lowest end of the interval of an order that counts as 1 / N.
constexpr double kDecided = 0.75;
constexpr double kRoundingShare = 0.25;
constexpr double kPercent = 0.01, kTiny = 1e-300;
// Heavy tails are a property of few among many pixels.
constexpr std::size_t kMinPixels = 100;

// Returns the variance of rounding to the nearest of floats with so many bits.
double RoundingVariance(double value, int fraction_bits, int min_exponent) {
  const int exponent =
      value == 0 ? min_exponent : std::max(min_exponent, std::ilogb(value));
  const double spacing = std::ldexp(1, exponent - fraction_bits);
  return value == 0 ? 0 : spacing * spacing / 12;
}

std::size_t CountOf(double fraction, std::size_t pixels) {
  return std::max<std::size_t>(1, std::size_t(std::lround(fraction * double(pixels))));
}

// Returns the indices of the largest values, largest first.
std::vector<std::size_t> LargestOf(const std::vector<double>& values, std::size_t count) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto end = order.begin() + long(std::min(count, order.size()));
  std::partial_sort(order.begin(), end, order.end(),
                    [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  order.erase(end, order.end());
  return order;
}

double ShareOf(const std::vector<double>& values, const std::vector<std::size_t>& which) {
  double all = 0, sum = 0;
  for (const double v : values) all += v;
  for (const std::size_t i : which) sum += values[i];
  return all > 0 ? sum / all : 0;
}

// The images at the largest count, and errors of other images against them.
class Reference {
 public:
  explicit Reference(const ErrorCurve& curve) : seeds_(double(curve.seeds)) {
    for (std::size_t s = 0; s < curve.seeds; ++s) {
      images_.push_back(curve.image(curve.samples.size() - 1, s));
      const LinearImage& image = images_.back();
      for (int c = 0; c < 3; ++c) {
        sums_[c].resize(image.pixels());
        for (std::size_t i = 0; i < image.pixels(); ++i)
          sums_[c][i] += image.planes[c][i];
      }
    }
  }

  std::size_t pixels() const { return images_[0].pixels(); }
  int width() const { return images_[0].width; }
  const LinearImage& image(std::size_t seed) const { return images_[seed]; }

  // Returns the relative squared distance of a pixel from the mean of the other seeds.
  double Distance(const LinearImage& image, std::size_t seed, std::size_t pixel) const {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double others =
          (sums_[c][pixel] - images_[seed].planes[c][pixel]) / (seeds_ - 1);
      const double d = image.planes[c][pixel] - others;
      sum += d * d * Weight(c, pixel);
    }
    return sum / 3;
  }

  double MeanDistance(const LinearImage& image, std::size_t seed) const {
    double sum = 0;
    for (std::size_t i = 0; i < pixels(); ++i) sum += Distance(image, seed, i);
    return sum / double(pixels());
  }

  // Returns the variance over seeds `first`, `first` + step, ... by pixel.
  std::vector<double> Variances(std::size_t first, std::size_t step) const {
    std::vector<double> variances(pixels());
    for (std::size_t i = 0; i < pixels(); ++i) {
      for (int c = 0; c < 3; ++c) {
        double n = 0, mean = 0, squares = 0;
        for (std::size_t s = first; s < images_.size(); s += step) {
          const double d = images_[s].planes[c][i] - mean;
          mean += d / ++n;
          squares += d * (images_[s].planes[c][i] - mean);
        }
        variances[i] += squares / (n - 1) * Weight(c, i) / 3;
      }
    }
    return variances;
  }

  double Rounding(bool half) const {
    double sum = 0;
    for (std::size_t i = 0; i < pixels(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const double mean = sums_[c][i] / seeds_;
        sum += Weight(c, i) * (half ? RoundingVariance(mean, 10, -14)
                                    : RoundingVariance(mean, 23, -126));
      }
    }
    return sum / 3 / double(pixels());
  }

 private:
  double Weight(int c, std::size_t pixel) const {
    const double mean = sums_[c][pixel] / seeds_;
    return 1 / (mean * mean + kRelativeEpsilon);
  }

  const double seeds_;
  std::vector<LinearImage> images_;
  std::array<std::vector<double>, 3> sums_;
};

// The worst pixels, most error first, with their shares of the error.
struct WorstPixels {
  std::vector<std::size_t> pixels;
  std::vector<double> shares;
};

// Measures over all images: errors by count and seed, and the grey values of the worst
// pixels.
struct Measured {
  std::vector<stat::Level> levels;
  std::vector<std::vector<std::vector<double>>> greys;  // by count, pixel and seed
};

// Removes the error of the reference, but no rounding.
void Correct(double seeds, double rounding, std::vector<stat::Level>& levels) {
  for (double& error : levels.back().error) error *= (seeds - 1) / seeds;
  const double own = stat::Mean(levels.back().error) / (seeds - 1);
  for (stat::Level& level : levels) {
    const double less = &level == &levels.back() ? 0 : own;
    for (double& error : level.error) error = std::max(error - less, rounding);
  }
}

Measured MeasureImages(const ErrorCurve& curve, const Reference& reference,
                       double rounding, const WorstPixels& worst) {
  Measured out;
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    out.levels.push_back({curve.samples[i], {}, {}});
    out.greys.emplace_back(worst.pixels.size());
    for (std::size_t s = 0; s < curve.seeds; ++s) {
      const bool last = i + 1 == curve.samples.size();
      const LinearImage own = last ? LinearImage() : curve.image(i, s);
      const LinearImage& image = last ? reference.image(s) : own;
      out.levels[i].error.push_back(reference.MeanDistance(image, s));
      out.levels[i].seconds.push_back(0);
      for (std::size_t k = 0; k < worst.pixels.size(); ++k) {
        double grey = 0;
        for (const Plane& plane : image.planes) grey += plane[worst.pixels[k]];
        out.greys[i][k].push_back(grey);
      }
    }
  }
  Correct(double(curve.seeds), rounding, out.levels);
  return out;
}

double SkewnessOf(const std::vector<double>& values) {
  const double mean = stat::Mean(values);
  double squares = 0, cubes = 0;
  for (const double v : values) {
    squares += (v - mean) * (v - mean);
    cubes += (v - mean) * (v - mean) * (v - mean);
  }
  const auto n = double(values.size());
  return squares > 0 ? cubes / n / std::pow(squares / n, 1.5) : 0;
}

// Sets the mean skewness of the worst pixels; returns it in standard deviations of what
// normal values have. Images of one seed may share samples: means of N and M > N samples
// then correlate by sqrt(N / M), and their skewness by the cube of that.
double FindSkewness(const Measured& measured, const WorstPixels& worst,
                    Convergence& out) {
  double weights = 0, squares = 0, sum = 0, correlated = 0;
  for (std::size_t k = 0; k < worst.pixels.size(); ++k) {
    weights += worst.shares[k];
    squares += worst.shares[k] * worst.shares[k];
    for (const auto& of_count : measured.greys) {
      sum += worst.shares[k] * SkewnessOf(of_count[k]);
    }
  }
  for (const double a : out.samples) {
    for (const double b : out.samples) {
      correlated += std::pow(std::min(a, b) / std::max(a, b), 1.5);
    }
  }
  const auto n = double(measured.greys[0][0].size());
  const double variance = 6 * (n - 2) / ((n + 1) * (n + 3));
  if (!(weights > 0)) return 0;
  out.skewness = sum / weights / double(out.samples.size());
  return sum / std::sqrt(squares * correlated * variance);
}

Interval OrderOf(std::span<const stat::Level> levels, double confidence) {
  const auto fit = stat::FitOrder(levels, confidence);  // of the root of the error
  if (!fit) return WithoutBounds(std::nan(""));
  return {-2 * fit->value, -2 * fit->high, -2 * fit->low};
}

bool IsSlow(const Interval& order) { return order.HasBounds() && order.high < kMinOrder; }

// Sets orders, and from where the error falls slowly.
void FindFall(std::span<const stat::Level> levels, double confidence, Convergence& out) {
  const std::size_t steps = levels.size() - 1;
  out.order = OrderOf(levels, kConfidence);
  std::vector<Interval> rest;  // from each count to the last
  for (std::size_t i = 0; i < steps; ++i) {
    out.orders.push_back(OrderOf(levels.subspan(i, 2), confidence));
    rest.push_back(OrderOf(levels.subspan(i), confidence));
  }
  const auto lower = [](const Interval& a, const Interval& b) { return a.high < b.high; };
  out.from = std::size_t(std::ranges::min_element(rest, lower) - rest.begin());
  for (std::size_t i = steps; i-- > 0;) {
    if (IsSlow(out.orders[i]) && IsSlow(rest[i])) out.from = i;
  }
  if (IsSlow(rest[out.from])) {
    out.fall = Fall::kSlower;
  } else if (out.order.low > kDecided) {
    out.fall = Fall::kAsExpected;
  }
}

// Returns the worst pixels, and sets what is known of them.
WorstPixels FindPixels(const Reference& reference, Convergence& out) {
  const std::vector<double> errors = reference.Variances(0, 1);
  const std::size_t percent = CountOf(kPercent, errors.size());
  WorstPixels worst = {LargestOf(errors, percent), {}};
  out.worst_share =
      ShareOf(errors, LargestOf(errors, CountOf(kWorstFraction, errors.size())));
  out.percent_share = ShareOf(errors, worst.pixels);
  const std::vector<std::size_t> even = LargestOf(reference.Variances(0, 2), percent),
                                 odd = LargestOf(reference.Variances(1, 2), percent);
  std::vector<std::size_t> both;  // of the worst in either half
  for (const std::size_t i : worst.pixels) {
    if (std::ranges::count(even, i) + std::ranges::count(odd, i) == 2) both.push_back(i);
  }
  out.repeated = ShareOf(errors, both) / std::max(out.percent_share, kTiny);
  const auto width = std::size_t(reference.width());
  for (const std::size_t i : worst.pixels) {
    worst.shares.push_back(errors[i]);
    if (out.pixels.size() == kMaxBlamed) continue;
    out.pixels.push_back({int(i % width), int(i / width), ShareOf(errors, {i})});
  }
  return worst;
}

}  // namespace

Convergence AnalyseCurve(const ErrorCurve& curve) {
  LL_CHECK(curve.seeds >= kMinCurveSeeds && curve.samples.size() >= 2);
  const Reference reference(curve);
  Convergence out;
  out.samples = curve.samples;
  out.rounding = reference.Rounding(curve.half);
  const WorstPixels worst = FindPixels(reference, out);
  const Measured measured = MeasureImages(curve, reference, out.rounding, worst);
  for (const stat::Level& level : measured.levels) {
    out.relmse.push_back(stat::MeanInterval(level.error, kConfidence));
  }
  if (out.relmse[0].value <= 2 * out.rounding) {
    out.fall = Fall::kExact;
    return out;
  }
  // Half of the level for orders, half for skewness.
  const double level = (1 - kConfidence) / 2;
  const int orders = 2 * int(curve.samples.size() - 1) - 1;
  // One-sided: only low orders are blamed.
  FindFall(measured.levels, 1 - 2 * stat::SidakLevel(level, orders), out);
  const double skewed = FindSkewness(measured, worst, out);
  if (out.fall == Fall::kSlower) out.cause = FallCause::kUnknown;
  const bool doubtful = out.fall != Fall::kAsExpected || out.worst_share > kHeavyTail;
  if (doubtful && reference.pixels() >= kMinPixels &&
      skewed > stat::NormalQuantile(1 - level)) {
    out.cause = FallCause::kHeavyTails;
  }
  if (out.rounding > kRoundingShare * out.relmse.back().value) {
    out.cause = FallCause::kRounding;
  }
  return out;
}

}  // namespace lanelight
