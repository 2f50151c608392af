#include "src/measure/compare/linear_image.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/image/image.h"
#include "src/base/stat/relative_error.h"
#include "src/measure/compare/tile_test.h"

namespace lanelight {
namespace {

// Returns the first of 1, 2, 5, 10, ... that is not below x.
double RoundUp(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= x) return digit * power;
  }
  return 10 * power;
}

struct ErrorSum {
  double error = 0;
  std::size_t count = 0;
};

}  // namespace

std::vector<float> LinearImage::Interleaved() const {
  std::vector<float> values;
  values.reserve(3 * pixels());
  for (std::size_t i = 0; i < pixels(); ++i) {
    for (const Plane& plane : planes) values.push_back(plane[i]);
  }
  return values;
}

LinearImage LinearOf(const Image& image) {
  const auto channels = ColorChannels(image);
  if (!channels) throw InputError(NoColorChannels(image));
  LinearImage out = {image.width, image.height, {}};
  for (int c = 0; c < 3; ++c) {
    out.planes[c].reserve(out.pixels());
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        out.planes[c].push_back(float(LinearValue(image, x, y, (*channels)[c])));
      }
    }
  }
  return out;
}

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
    out.difference[i] = float(signed_sum / std::sqrt(base * base + kRelativeEpsilon));
    out.relative[i] = float(std::sqrt(relative));
    out.absolute[i] = float(std::sqrt(absolute));
  }
  return out;
}

double ScaleOf(const Plane& values) {
  std::vector<float> sizes;
  for (float v : values) {
    if (std::isfinite(v)) sizes.push_back(std::abs(v));
  }
  if (sizes.empty()) return 1;
  const auto at = sizes.begin() + long(0.98 * double(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  if (*at > 0) return RoundUp(*at);
  const float largest = *std::ranges::max_element(sizes);
  return largest > 0 ? RoundUp(largest) : 1;
}

std::vector<ErrorTile> WorstTiles(const LinearImage& test, const LinearImage& reference,
                                  std::size_t maximum) {
  const TileLayout layout = LayoutOf(test.width, test.height);
  std::vector<ErrorSum> sums(layout.size());
  double total = 0;
  for (std::size_t i = 0; i < test.pixels(); ++i) {
    const int x = int(i % test.width), y = int(i / test.width);
    for (int c = 0; c < 3; ++c) {
      const double b = reference.planes[c][i], d = test.planes[c][i] - b;
      const double error = d * d / (b * b + kRelativeEpsilon);
      if (!std::isfinite(error)) continue;
      sums[layout.At(x, y)].error += error;
      ++sums[layout.At(x, y)].count;
      total += error;
    }
  }
  std::vector<ErrorTile> out;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!(sums[i].error > 0)) continue;
    const int x = int(i) % layout.columns * layout.side;
    const int y = int(i) / layout.columns * layout.side;
    out.push_back({x, y, std::min(layout.side, test.width - x),
                   std::min(layout.side, test.height - y),
                   sums[i].error / double(sums[i].count), sums[i].error / total});
  }
  std::ranges::sort(
      out, [](const ErrorTile& a, const ErrorTile& b) { return a.share > b.share; });
  out.resize(std::min(out.size(), maximum));
  return out;
}

}  // namespace lanelight
