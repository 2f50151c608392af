#include "src/measure/compare/error_maps.h"

#include <algorithm>
#include <cmath>

#include "src/base/stat/relative_error.h"

namespace lanelight {
namespace {

// The first of 1, 2, 5, 10, ... that is not below x.
double RoundUp(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= x) return digit * power;
  }
  return 10 * power;
}

}  // namespace

ErrorMaps ErrorMapsOf(const LinearImage& test, const LinearImage& reference) {
  ErrorMaps out;
  for (Plane* plane : {&out.difference, &out.relative, &out.absolute}) {
    plane->resize(test.pixels());
  }
  for (std::size_t i = 0; i < test.pixels(); ++i) {
    double signed_sum = 0, base = 0, relative = 0, absolute = 0;
    for (int c = 0; c < 3; ++c) {
      const double b = reference.planes[c][i], d = test.planes[c][i] - b;
      signed_sum += d / 3, base += b / 3;
      relative += d * d / (b * b + kRelativeEpsilon) / 3, absolute += d * d / 3;
    }
    out.difference[i] =
        static_cast<float>(signed_sum / std::sqrt(base * base + kRelativeEpsilon));
    out.relative[i] = static_cast<float>(std::sqrt(relative));
    out.absolute[i] = static_cast<float>(std::sqrt(absolute));
  }
  return out;
}

double ScaleOf(const Plane& values) {
  std::vector<float> sizes;
  for (float v : values) {
    if (std::isfinite(v)) sizes.push_back(std::abs(v));
  }
  if (sizes.empty()) return 1;
  const auto at = sizes.begin() + static_cast<long>(0.98 * double(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  if (*at > 0) return RoundUp(*at);
  const float largest = *std::max_element(sizes.begin(), sizes.end());
  return largest > 0 ? RoundUp(largest) : 1;
}

}  // namespace lanelight
