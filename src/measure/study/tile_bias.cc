// Where an image differs from the reference by more than noise.
#include <algorithm>
#include <cmath>

#include "src/base/stat/hypothesis.h"
#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

// Of the pixels of a tile.
struct TileMeans {
  std::vector<stat::MeanEstimate> image, reference;
};

}  // namespace

// The mean of a tile varies by what its pixels do, with more degrees of freedom than its
// own repetitions have (Welch and Satterthwaite).
TileTest TestTiles(const Moments& moments, const Reference& reference, std::uint64_t spp,
                   double level) {
  TileTest test;
  test.level = level;
  test.layout = LayoutOf(reference.width, reference.height);
  std::vector<TileMeans> tiles(test.layout.size());
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      const std::size_t tile = test.layout.At(x, y);
      const std::size_t pixel = static_cast<std::size_t>(y) * reference.width + x;
      tiles[tile].image.push_back(moments.GreyEstimate(pixel));
      tiles[tile].reference.push_back(reference.GreyEstimate(pixel));
    }
  }
  for (const TileMeans& tile : tiles) {
    test.means.push_back(stat::Average(tile.image, moments.pixels_as_one));
    test.reference.push_back(stat::Average(tile.reference));
  }
  const double samples = double(spp) * double(moments.count());
  std::vector<double> p;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const stat::MeanEstimate b = test.reference[i];
    stat::MeanEstimate a = test.means[i];
    a.variance =
        std::max(a.variance, VarianceAround(test.layout, test.means, i).variance);
    if (!RestsOnEnough(a, b, double(reference.spp) / samples)) {
      p.push_back(1);
      test.z.push_back(std::nan(""));
      continue;
    }
    p.push_back(stat::WelchPValue(a, b, kFloatRounding * std::abs(b.mean)));
    test.z.push_back(SignedZ(p.back(), a, b));
  }
  test.failed = stat::HolmRejections(p, level);
  return test;
}

}  // namespace lanelight
