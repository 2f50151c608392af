// Tests images and tiles for differences from the reference beyond noise, and attributes
// them to the strategy or to the reference.

#include <algorithm>
#include <cmath>

#include "src/base/stat/hypothesis.h"
#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

using stat::MeanEstimate;

// Level of the test that the other strategies differ from the reference too.
constexpr double kOthersLevel = 0.05;

// Returns whether a difference from the reference agrees with the other strategies, which
// points at the reference. `tests`: number of differences of the strategy.
bool PointsAtReference(const MeanEstimate& own, const MeanEstimate& reference,
                       const std::vector<MeanEstimate>& others, std::size_t tests) {
  if (others.empty()) return false;
  const double rounding = kFloatRounding * std::max(std::abs(own.mean), 1e-30);
  const double minimum = rounding * rounding;
  if (stat::DeparturePValue(own, others, minimum) < kBiasLevel / double(tests)) {
    return false;
  }
  const MeanEstimate consensus = stat::ConsensusOf(others, minimum).estimate;
  const bool same_side = (own.mean > reference.mean) == (consensus.mean > reference.mean);
  return same_side && stat::WelchPValue(consensus, reference) < kOthersLevel;
}

class BiasTests {
 public:
  explicit BiasTests(SceneAnalysis& out) : out_(out) {}

  void Run(const MeanEstimate& reference) {
    out_.bias_level = kBiasLevel;
    // Most renders of heavy-tailed strategies miss the rarest samples, which their
    // variance does not show: their mean is low without bias.
    for (std::size_t i = 0; i < out_.strategies.size(); ++i) {
      const StrategyAnalysis& s = out_.strategies[i];
      if (s.HasRuns() && s.AtLevel().bias_p && !s.heavy_tailed) tested_.push_back(i);
    }
    TestImages(reference);
    for (StrategyAnalysis& s : out_.strategies) {
      if (s.tiles && s.heavy_tailed) s.tiles->failed.clear();
    }
    for (std::size_t i : tested_) JudgeTiles(i);
    std::ranges::sort(out_.suspect_tiles);
    out_.suspect_tiles.erase(
        std::unique(out_.suspect_tiles.begin(), out_.suspect_tiles.end()),
        out_.suspect_tiles.end());
  }

 private:
  template <class Get>
  std::vector<MeanEstimate> Others(std::size_t strategy, Get&& get) const {
    std::vector<MeanEstimate> others;
    for (std::size_t i : tested_) {
      if (i != strategy) others.push_back(get(out_.strategies[i]));
    }
    return others;
  }

  void TestImages(const MeanEstimate& reference) {
    std::vector<double> p;
    for (std::size_t i : tested_) p.push_back(*out_.strategies[i].AtLevel().bias_p);
    out_.bias_tests = p.size();
    const std::vector<std::size_t> rejected = stat::HolmRejections(p, kBiasLevel);
    for (std::size_t k : rejected) {
      const auto others =
          Others(tested_[k], [](const StrategyAnalysis& s) { return s.image_mean; });
      const MeanEstimate& own = out_.strategies[tested_[k]].image_mean;
      const bool shared = PointsAtReference(own, reference, others, rejected.size());
      (shared ? out_.biased_alike : out_.biased).push_back(tested_[k]);
    }
  }

  void JudgeTiles(std::size_t index) {
    std::optional<TileTest>& test = out_.strategies[index].tiles;
    if (!test) return;
    const std::vector<std::size_t> differing = std::move(test->failed);
    test->failed.clear();
    for (std::size_t tile : differing) {
      const auto others =
          Others(index, [&](const StrategyAnalysis& s) { return s.tiles->means[tile]; });
      if (PointsAtReference(test->means[tile], test->reference[tile], others,
                            differing.size())) {
        test->shared.push_back(tile);
        out_.suspect_tiles.push_back(tile);
      } else {
        test->failed.push_back(tile);
      }
    }
  }

  SceneAnalysis& out_;
  std::vector<std::size_t> tested_;  // indices of strategies
};

// Estimates of the pixels of a tile.
struct TileMeans {
  std::vector<stat::MeanEstimate> image, reference;
};

}  // namespace

void TestBias(const Reference& reference, SceneAnalysis& analysis) {
  if (reference.mean.empty()) return;  // interrupted before there was one
  BiasTests(analysis).Run(ReferenceMean(reference));
}

// The variance of a tile's mean is that of its pixels, which has more degrees of freedom
// than that of the repetitions of the tile (Welch and Satterthwaite).
TileTest TestTiles(const Moments& moments, const Reference& reference, std::uint64_t spp,
                   double level) {
  TileTest test;
  test.level = level;
  test.layout = LayoutOf(reference.width, reference.height);
  std::vector<TileMeans> tiles(test.layout.size());
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      const std::size_t tile = test.layout.At(x, y);
      const std::size_t pixel = std::size_t(y) * reference.width + x;
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
    if (!HasEnoughObservations(a, b, double(reference.spp) / samples)) {
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
