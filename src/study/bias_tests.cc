// Which images differ from what they should be by more than noise, and whether that
// speaks of their strategy or of the reference that all share.
#include <algorithm>
#include <cmath>

#include "src/stat/consensus.h"
#include "src/stat/multiple.h"
#include "src/study/analysis.h"

namespace lanelight {
namespace {

using stat::MeanEstimate;

class BiasTests {
 public:
  explicit BiasTests(SceneAnalysis& out) : out_(out) {}

  void Run() {
    out_.bias_level = kBiasLevel;
    TestImages();
    for (std::size_t i = 0; i < out_.strategies.size(); ++i) JudgeTiles(i);
    std::sort(out_.suspect_tiles.begin(), out_.suspect_tiles.end());
    out_.suspect_tiles.erase(
        std::unique(out_.suspect_tiles.begin(), out_.suspect_tiles.end()),
        out_.suspect_tiles.end());
  }

 private:
  // Whether a strategy whose mean differs from the reference also differs from those of
  // the others, at a level that all `tests` of it share.
  bool DiffersFromOthers(const MeanEstimate& own, const std::vector<MeanEstimate>& others,
                         std::size_t tests) const {
    if (others.empty()) return true;  // nobody knows better than the reference
    const double rounding = kFloatRounding * std::max(std::abs(own.mean), 1e-30);
    return stat::DeparturePValue(own, others, rounding * rounding) <
           kBiasLevel / double(tests);
  }

  void TestImages() {
    std::vector<double> p;
    std::vector<std::size_t> tested;
    for (std::size_t i = 0; i < out_.strategies.size(); ++i) {
      const StrategyAnalysis& strategy = out_.strategies[i];
      if (!strategy.HasRuns() || !strategy.AtLevel().bias_p) continue;
      // Most renders miss the rarest samples, and their scatter does not show it: the
      // mean is low without being biased.
      if (strategy.heavy_tailed) continue;
      p.push_back(*strategy.AtLevel().bias_p);
      tested.push_back(i);
    }
    out_.bias_tests = p.size();
    const std::vector<std::size_t> rejected = stat::HolmRejections(p, kBiasLevel);
    for (std::size_t k : rejected) {
      std::vector<MeanEstimate> others;
      for (std::size_t i : tested) {
        if (i != tested[k]) others.push_back(out_.strategies[i].image_mean);
      }
      const MeanEstimate& own = out_.strategies[tested[k]].image_mean;
      const bool alone = DiffersFromOthers(own, others, rejected.size());
      (alone ? out_.biased : out_.biased_alike).push_back(tested[k]);
    }
  }

  void JudgeTiles(std::size_t index) {
    std::optional<TileTest>& test = out_.strategies[index].tiles;
    if (!test) return;
    const std::vector<std::size_t> differing = std::move(test->failed);
    test->failed.clear();
    for (std::size_t tile : differing) {
      std::vector<MeanEstimate> others;
      for (std::size_t i = 0; i < out_.strategies.size(); ++i) {
        if (i == index || !out_.strategies[i].tiles) continue;
        others.push_back(out_.strategies[i].tiles->means[tile]);
      }
      if (DiffersFromOthers(test->means[tile], others, differing.size())) {
        test->failed.push_back(tile);
      } else {
        test->shared.push_back(tile);
        out_.suspect_tiles.push_back(tile);
      }
    }
  }

  SceneAnalysis& out_;
};

}  // namespace

void TestBias(SceneAnalysis& analysis) { BiasTests(analysis).Run(); }

}  // namespace lanelight
