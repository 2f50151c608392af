#include "tests/base/stat/compare_means.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "src/base/core/check.h"
#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"
#include "tests/base/stat/kolmogorov.h"

namespace lanelight::stat {
namespace {

struct Rect {
  int x0, y0, x1, y1;
};

MeanEstimate RectMean(const ImageEstimate& image, const Rect& r, int channel) {
  std::vector<MeanEstimate> pixels;
  for (int y = r.y0; y < r.y1; ++y) {
    for (int x = r.x0; x < r.x1; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * image.width + x;
      pixels.push_back(
          {image.mean[i][channel], image.variance[i][channel], image.observations - 1});
    }
  }
  return Average(pixels);
}

std::vector<Rect> Tiles(int width, int height, int size) {
  std::vector<Rect> tiles;
  for (int y = 0; y < height; y += size) {
    for (int x = 0; x < width; x += size) {
      tiles.push_back({x, y, std::min(x + size, width), std::min(y + size, height)});
    }
  }
  return tiles;
}

// The relative error found with probability 0.95 by a test of this level.
double DetectableBias(const ImageEstimate& a, const ImageEstimate& b, double level) {
  const Rect all = {0, 0, a.width, a.height};
  double best = 1e300;
  for (int c = 0; c < 3; ++c) {
    const MeanEstimate ma = RectMean(a, all, c), mb = RectMean(b, all, c);
    const double error = std::sqrt(ma.variance + mb.variance);
    const double reach = NormalQuantile(1 - level / 2) + NormalQuantile(0.95);
    if (ma.mean > 0) best = std::min(best, reach * error / ma.mean);
  }
  return best;
}

}  // namespace

ImageEstimate ExpectedImage(int width, int height,
                            const std::function<Rgb(int, int)>& f) {
  ImageEstimate image = {width, height, 2, {}, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.mean.push_back(f(x, y));
  }
  image.variance.resize(image.mean.size());
  return image;
}

std::string ImageTestResult::ToString() const {
  return fmt::format(
      "{}: {} tests at level {:.3g}, smallest p {:.3g} ({}); uniformity p {:.3g}; "
      "a bias of {:.3g} % would be found",
      same ? "same" : "DIFFERENT", tests, level, smallest_p, worst, uniformity_p,
      100 * detectable_bias);
}

ImageTestResult CompareMeans(const ImageEstimate& a, const ImageEstimate& b,
                             const ImageTestOptions& options) {
  LL_CHECK_EQ(a.width, b.width);
  LL_CHECK_EQ(a.height, b.height);
  LL_CHECK_EQ(a.mean.size(), b.mean.size());
  std::vector<Rect> rects = Tiles(a.width, a.height, options.tile);
  const std::size_t tiles = rects.size();
  rects.push_back({0, 0, a.width, a.height});
  ImageTestResult result;
  result.tests = static_cast<int>(3 * rects.size());
  result.level = SidakLevel(options.false_alarm, result.tests);
  std::vector<double> tile_p;
  for (std::size_t i = 0; i < rects.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const MeanEstimate ma = RectMean(a, rects[i], c), mb = RectMean(b, rects[i], c);
      const double scale = std::max(std::abs(ma.mean), std::abs(mb.mean));
      const double p = WelchPValue(
          ma, mb, options.absolute_tolerance + options.relative_tolerance * scale);
      if (c == 1 && i < tiles && ma.variance + mb.variance > 0) tile_p.push_back(p);
      if (p >= result.smallest_p) continue;
      result.smallest_p = p;
      result.worst = fmt::format(
          "[{},{})x[{},{}) channel {}: {:.6g} vs {:.6g}, standard error {:.3g}",
          rects[i].x0, rects[i].x1, rects[i].y0, rects[i].y1, c, ma.mean, mb.mean,
          std::sqrt(ma.variance + mb.variance));
    }
  }
  result.same = result.smallest_p >= result.level;
  if (tile_p.size() >= 8) result.uniformity_p = KsUniformPValue(tile_p);
  result.detectable_bias = DetectableBias(a, b, result.level);
  return result;
}

void CheckSame(const ImageTestResult& result, const std::string& what) {
  INFO(what << ": " << result.ToString());
  CHECK(result.same);
}

void CheckSame(const ImageTestResult& result, double power, const std::string& what) {
  INFO(what << ": " << result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < power);
}

}  // namespace lanelight::stat
