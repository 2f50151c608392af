// Which images differ from what they should be by more than noise, and whether that
// speaks of their strategy or of the reference that all share.
#include <algorithm>
#include <cmath>

#include "src/base/stat/hypothesis.h"
#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

using stat::MeanEstimate;

// Evidence that the others do not agree with the reference either.
constexpr double kOthersLevel = 0.05;

// Of what differs from the reference: whether the others say the same, so that it speaks
// against the reference. `tests`: how many differences of the strategy are looked at.
bool PointsAtReference(const MeanEstimate& own, const MeanEstimate& reference,
                       const std::vector<MeanEstimate>& others, std::size_t tests) {
  if (others.empty()) return false;
  const double rounding = kFloatRounding * std::max(std::abs(own.mean), 1e-30);
  const double least = rounding * rounding;
  if (stat::DeparturePValue(own, others, least) < kBiasLevel / double(tests)) {
    return false;
  }
  const MeanEstimate consensus = stat::ConsensusOf(others, least).estimate;
  const bool same_side = (own.mean > reference.mean) == (consensus.mean > reference.mean);
  return same_side && stat::WelchPValue(consensus, reference) < kOthersLevel;
}

class BiasTests {
 public:
  explicit BiasTests(SceneAnalysis& out) : out_(out) {}

  void Run(const MeanEstimate& reference) {
    out_.bias_level = kBiasLevel;
    // Most renders miss the rarest samples, and their scatter does not show it: the mean
    // is low without being biased.
    for (std::size_t i = 0; i < out_.strategies.size(); ++i) {
      const StrategyAnalysis& s = out_.strategies[i];
      if (s.HasRuns() && s.AtLevel().bias_p && !s.heavy_tailed) tested_.push_back(i);
    }
    TestImages(reference);
    for (StrategyAnalysis& s : out_.strategies) {
      if (s.tiles && s.heavy_tailed) s.tiles->failed.clear();
    }
    for (std::size_t i : tested_) JudgeTiles(i);
    std::sort(out_.suspect_tiles.begin(), out_.suspect_tiles.end());
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
  std::vector<std::size_t> tested_;  // strategies
};

}  // namespace

void TestBias(const Reference& reference, SceneAnalysis& analysis) {
  if (reference.mean.empty()) return;  // interrupted before there was one
  BiasTests(analysis).Run(ReferenceMean(reference));
}

}  // namespace lanelight
