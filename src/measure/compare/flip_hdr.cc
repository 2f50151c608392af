// FLIP of images of a high dynamic range, at several exposures.
#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/measure/compare/flip.h"

namespace lanelight {
namespace {

// Narkowicz's (2015) fit to the tone curve of ACES, without its own change of exposure:
// (kTop[0] x^2 + kTop[1] x) / (kBottom[0] x^2 + kBottom[1] x + kBottom[2]).
constexpr double kTop[] = {0.6 * 0.6 * 2.51, 0.6 * 0.03};
constexpr double kBottom[] = {0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};
// Bright, but not clipped.
constexpr double kBright = 0.85;
// Weights of luminance, with the digits that the authors give them.
constexpr double kWeights[] = {0.2126, 0.7152, 0.0722};
// The curve is flat here, and squares are still finite.
constexpr double kLevel = 1e15;

double ToneCurve(double x) {
  x = x > 0 ? std::min(x, kLevel) : 0;  // a NaN is black
  return std::min(1.0, (kTop[0] * x + kTop[1]) * x /
                           ((kBottom[0] * x + kBottom[1]) * x + kBottom[2]));
}

// The larger root of ToneCurve(x) = kBright.
double BrightInput() {
  const double a = kTop[0] - kBright * kBottom[0], b = kTop[1] - kBright * kBottom[1],
               c = -kBright * kBottom[2];
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

LinearImage Toned(const LinearImage& image, double exposure) {
  const double gain = std::exp2(exposure);
  LinearImage out = image;
  for (Plane& plane : out.planes) {
    for (float& value : plane) value = float(ToneCurve(gain * value));
  }
  return out;
}

}  // namespace

FlipExposures ExposuresOf(const LinearImage& reference) {
  constexpr double kMinLuminance = 1e-30;  // of a luminance, whose logarithm is computed
  std::vector<double> luminances;
  for (std::size_t i = 0; i < reference.pixels(); ++i) {
    double y = 0;
    for (int c = 0; c < 3; ++c) y += kWeights[c] * reference.planes[c][i];
    if (std::isfinite(y)) luminances.push_back(std::max(y, kMinLuminance));
  }
  if (luminances.empty()) return {0, 1, 2};
  const auto middle = luminances.begin() + long(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  const double median = *middle;
  const double brightest = *std::ranges::max_element(luminances);
  if (brightest <= kMinLuminance) return {0, 1, 2};
  FlipExposures out;
  out.start = std::log2(BrightInput() / brightest);
  // Limits the range for images that are mostly black.
  constexpr double kMaxRange = 32;
  out.stop = std::min(std::log2(BrightInput() / median), out.start + kMaxRange);
  out.count = std::max(2, int(std::ceil(out.stop - out.start)));
  return out;
}

Plane HdrFlip(const LinearImage& reference, const LinearImage& test,
              const FlipExposures& exposures, double pixels_per_degree) {
  LL_CHECK(exposures.count >= 2);
  Plane map(reference.pixels(), 0.0f);
  const double step = (exposures.stop - exposures.start) / (exposures.count - 1);
  for (int i = 0; i < exposures.count; ++i) {
    const double exposure = exposures.start + i * step;
    const Plane one =
        LdrFlip(Toned(reference, exposure), Toned(test, exposure), pixels_per_degree);
    for (std::size_t p = 0; p < map.size(); ++p) map[p] = std::max(map[p], one[p]);
  }
  return map;
}

}  // namespace lanelight
