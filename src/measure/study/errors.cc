#include "src/measure/study/reference.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/measure/compare/metrics.h"
#include "src/render/estimate/estimate.h"

namespace lanelight {
namespace {

// Relative squared error of a pixel, and the expected part of the reference's own error.
struct PixelError {
  double raw = 0, own = 0;
};

double SumRaw(const PixelError* begin, const PixelError* end) {
  double sum = 0;
  for (const PixelError* p = begin; p != end; ++p) sum += p->raw;
  return sum;
}

std::size_t Count(double fraction, std::size_t pixels) {
  return std::max<std::size_t>(1, std::size_t(std::lround(fraction * double(pixels))));
}

void MeasureRelative(std::vector<PixelError> errors, Measurement& m) {
  const std::size_t n = errors.size();
  double own = 0;
  for (const PixelError& e : errors) own += e.own;
  const double raw = SumRaw(errors.data(), errors.data() + n);
  m.raw_relmse = raw / double(n);
  m.relmse = (raw - own) / double(n);

  const auto worse = [](const PixelError& a, const PixelError& b) {
    return a.raw > b.raw;
  };
  const std::size_t worst = Count(kWorstFraction, n),
                    trimmed = Count(kTrimmedFraction, n);
  std::nth_element(errors.begin(), errors.begin() + trimmed - 1, errors.end(), worse);
  std::nth_element(errors.begin(), errors.begin() + worst - 1, errors.begin() + trimmed,
                   worse);
  m.worst_share = raw > 0 ? SumRaw(errors.data(), errors.data() + worst) / raw : 0;
  double kept = 0;
  for (std::size_t i = trimmed; i < n; ++i) kept += errors[i].raw - errors[i].own;
  m.relmse_trimmed = n > trimmed ? kept / double(n - trimmed) : m.relmse;
}

// Returns the relative MSE of means over squares, without the reference's own error.
double FilteredError(const std::vector<Rgb>& image, const Reference& reference,
                     std::size_t side) {
  const auto width = std::size_t(reference.width);
  const std::size_t height = image.size() / width;
  double sum = 0, squares = 0;
  for (std::size_t y = 0; y < height; y += side) {
    for (std::size_t x = 0; x < width; x += side) {
      Rgb d, r, variance;
      double n = 0;
      for (std::size_t b = y; b < std::min(y + side, height); ++b) {
        for (std::size_t a = x; a < std::min(x + side, width); ++a, ++n) {
          const std::size_t i = b * width + a;
          d += image[i] - reference.mean[i];
          r += reference.mean[i];
          variance += reference.Variance(i);
        }
      }
      for (int c = 0; c < 3; ++c) {
        const double mean = r[c] / n;
        sum +=
            (d[c] * d[c] - variance[c]) / (n * n) / (mean * mean + kRelativeEpsilon) / 3;
      }
      ++squares;
    }
  }
  return sum / squares;
}

}  // namespace

void MeasureErrors(const std::vector<Rgb>& image, const Reference& reference,
                   Measurement& m) {
  LL_CHECK_EQ(image.size(), reference.mean.size());
  std::vector<PixelError> errors(image.size());
  double squares = 0, own = 0, percentage = 0;
  Rgb sum;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgb r = reference.mean[i], d = image[i] - r, weight = reference.Weight(i);
    const Rgb variance = reference.Variance(i);
    squares += Dot(d, d) / 3;
    own += (variance.x + variance.y + variance.z) / 3;
    for (int c = 0; c < 3; ++c) {
      percentage += std::abs(d[c]) / (std::abs(r[c]) + kRelativeEpsilon) / 3;
    }
    errors[i] = {Dot(d * d, weight) / 3, Dot(variance, weight) / 3};
    sum += image[i];
  }
  const double n = double(image.size());
  m.mse = (squares - own) / n;
  m.rmse = m.mse >= 0 ? std::sqrt(m.mse) : std::numeric_limits<double>::quiet_NaN();
  m.mape = percentage / n;
  m.mean_r = sum.x / n;
  m.mean_g = sum.y / n;
  m.mean_b = sum.z / n;
  const auto worst = std::max_element(
      errors.begin(), errors.end(),
      [](const PixelError& a, const PixelError& b) { return a.raw < b.raw; });
  const auto at = std::size_t(worst - errors.begin());
  m.worst_x = at % std::size_t(reference.width);
  m.worst_y = at / std::size_t(reference.width);
  MeasureRelative(std::move(errors), m);
  m.relmse_2 = FilteredError(image, reference, 2);
  m.relmse_4 = FilteredError(image, reference, 4);
  m.relmse_8 = FilteredError(image, reference, 8);
}

}  // namespace lanelight
