// Where an image differs from the reference by more than noise.
#include <algorithm>
#include <cmath>

#include "src/stat/distributions.h"
#include "src/stat/hypothesis.h"
#include "src/stat/multiple.h"
#include "src/study/analysis.h"

namespace lanelight {
namespace {

constexpr int kTiles = 192;  // about
constexpr int kLeastSide = 4;

int TileSide(const Reference& r) {
  const double pixels = double(r.width) * r.height;
  return std::max(kLeastSide, static_cast<int>(std::ceil(std::sqrt(pixels / kTiles))));
}

// Of the pixels of a tile.
struct TileMeans {
  std::vector<stat::MeanEstimate> image, reference;
};

// Where the mean is made of rare bright samples, an image may have missed them all, and
// its own scatter does not show it: at least so many of them must be expected.
constexpr double kLeastObservations = 25;

// Whether the mean of a tile rests on enough: (mean / standard error)^2 is how many
// samples of equal value would scatter as much. Also of the image by the reference's own
// variance, which has seen more samples, each one by itself.
bool IsTestable(const stat::MeanEstimate& image, const stat::MeanEstimate& reference,
                double reference_per_image) {
  const double signal = std::max(std::abs(image.mean), std::abs(reference.mean));
  const double variance =
      std::max(image.variance, reference.variance * std::max(1.0, reference_per_image));
  return signal * signal >= kLeastObservations * variance;
}

// Mean of the variances of the tiles around one, five by five: rare samples that it has
// missed have fallen there.
double VarianceAround(const TileTest& test, int tile) {
  constexpr int kReach = 2;
  const int row = tile / test.columns, column = tile % test.columns;
  double sum = 0;
  int count = 0;
  for (int y = row - kReach; y <= row + kReach; ++y) {
    for (int x = column - kReach; x <= column + kReach; ++x) {
      if (x < 0 || y < 0 || x >= test.columns || y >= test.rows) continue;
      sum += test.means[static_cast<std::size_t>(y * test.columns + x)].variance;
      ++count;
    }
  }
  return sum / count;
}

}  // namespace

// Pixels are independent, so the mean of a tile varies by what its pixels do, with more
// degrees of freedom than its own repetitions have (Welch and Satterthwaite).
TileTest TestTiles(const Moments& moments, const Reference& reference, std::uint64_t spp,
                   double level) {
  TileTest test;
  test.level = level;
  test.side = TileSide(reference);
  test.columns = (reference.width + test.side - 1) / test.side;
  test.rows = (reference.height + test.side - 1) / test.side;
  std::vector<TileMeans> tiles(static_cast<std::size_t>(test.columns) * test.rows);
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      const std::size_t tile =
          static_cast<std::size_t>(y / test.side) * test.columns + x / test.side;
      const std::size_t pixel = static_cast<std::size_t>(y) * reference.width + x;
      tiles[tile].image.push_back(moments.GreyEstimate(pixel));
      tiles[tile].reference.push_back(reference.GreyEstimate(pixel));
    }
  }
  for (const TileMeans& tile : tiles) {
    test.means.push_back(stat::Average(tile.image));
    test.reference.push_back(stat::Average(tile.reference));
  }
  const double samples = double(spp) * double(moments.count());
  std::vector<double> p;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const stat::MeanEstimate b = test.reference[i];
    stat::MeanEstimate a = test.means[i];
    a.variance = std::max(a.variance, VarianceAround(test, static_cast<int>(i)));
    if (!IsTestable(a, b, double(reference.spp) / samples)) {
      p.push_back(1);
      test.z.push_back(std::nan(""));
      continue;
    }
    p.push_back(stat::WelchPValue(a, b, kFloatRounding * std::abs(b.mean)));
    // The z-score of the same p-value; 9 and beyond are all the same to a reader.
    const double tail = std::clamp(p.back() / 2, 1e-19, 0.5);
    const double z = tail < 0.5 ? -stat::NormalQuantile(tail) : 0;
    test.z.push_back(a.mean < b.mean ? -z : z);
  }
  test.failed = stat::HolmRejections(p, level);
  return test;
}

}  // namespace lanelight
