// What a study's tests of bias say, in words.
#include "src/study/analysis.h"

namespace lanelight {
namespace {

class BiasSentences {
 public:
  BiasSentences(const SceneRuns& runs, const SceneAnalysis& analysis)
      : runs_(runs), analysis_(analysis) {}

  std::string Text() {
    Images();
    Tiles();
    Reference();
    return text_;
  }

 private:
  void Say(const std::string& sentence) {
    text_ += (text_.empty() ? "" : " ") + sentence;
  }

  // Heavy-tailed strategies are not tested.
  bool AnyHeavy() const {
    for (const StrategyAnalysis& s : analysis_.strategies) {
      if (s.heavy_tailed) return true;
    }
    return false;
  }

  void Images() {
    if (!analysis_.biased.empty()) {
      return Say(
          fmt::format("The mean image of {} differs from the reference by more than "
                      "noise (level {:g} "
                      "for all tests together).",
                      NamesText(runs_, analysis_.biased), analysis_.bias_level));
    }
    if (analysis_.bias_tests == 0 || !analysis_.biased_alike.empty()) return;
    Say(
        fmt::format("No {}mean image differs from the reference by more than noise ({} "
                    "test{}).",
                    AnyHeavy() ? "other " : "", analysis_.bias_tests,
                    analysis_.bias_tests == 1 ? "" : "s"));
  }

  void Tiles() {
    std::vector<std::size_t> differing;
    for (std::size_t i = 0; i < analysis_.strategies.size(); ++i) {
      const std::optional<TileTest>& tiles = analysis_.strategies[i].tiles;
      if (tiles && !tiles->failed.empty()) differing.push_back(i);
    }
    if (differing.empty()) return;
    Say("Parts of the image differ by more than noise for " +
        NamesText(runs_, differing) + ".");
  }

  void Reference() {
    if (!analysis_.biased_alike.empty()) {
      Say(
          fmt::format("The mean image of {} differs from the reference by more than "
                      "noise, but not from those of the others: that points at the "
                      "reference.",
                      NamesText(runs_, analysis_.biased_alike)));
    }
    const std::size_t tiles = analysis_.suspect_tiles.size();
    if (tiles == 0) return;
    Say(
        fmt::format("In {} tile{} of the image the strategies agree with each other and "
                    "not with the reference, which is less sure there than it says.",
                    tiles, tiles == 1 ? "" : "s"));
  }

  const SceneRuns& runs_;
  const SceneAnalysis& analysis_;
  std::string text_;
};

}  // namespace

std::string NamesText(const SceneRuns& runs, const std::vector<std::size_t>& strategies,
                      std::size_t most) {
  if (strategies.size() > most) return fmt::format("{} strategies", strategies.size());
  std::string text;
  for (std::size_t k = 0; k < strategies.size(); ++k) {
    text += k == 0 ? "" : k + 1 == strategies.size() ? " and " : ", ";
    text += runs.strategies[strategies[k]].named.name;
  }
  return text;
}

std::string BiasText(const SceneRuns& runs, const SceneAnalysis& analysis) {
  return BiasSentences(runs, analysis).Text();
}

}  // namespace lanelight
