// What a study's tests of bias say, in words.
#include <algorithm>

#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

// Heavy-tailed strategies are not tested.
bool AnyHeavy(const SceneAnalysis& analysis) {
  return std::any_of(analysis.strategies.begin(), analysis.strategies.end(),
                     [](const StrategyAnalysis& s) { return s.heavy_tailed; });
}

std::string ImagesText(const SceneRuns& runs, const SceneAnalysis& analysis) {
  if (!analysis.biased.empty()) {
    return fmt::format(
        "The mean image of {} differs from the reference by more than noise (level {:g} "
        "for all tests together).",
        NamesText(runs, analysis.biased), analysis.bias_level);
  }
  if (analysis.bias_tests == 0 || !analysis.biased_alike.empty()) return "";
  return fmt::format(
      "No {}mean image differs from the reference by more than noise ({} test{}).",
      AnyHeavy(analysis) ? "other " : "", analysis.bias_tests,
      analysis.bias_tests == 1 ? "" : "s");
}

std::string TilesText(const SceneRuns& runs, const SceneAnalysis& analysis) {
  std::vector<std::size_t> differing;
  for (std::size_t i = 0; i < analysis.strategies.size(); ++i) {
    const std::optional<TileTest>& tiles = analysis.strategies[i].tiles;
    if (tiles && !tiles->failed.empty()) differing.push_back(i);
  }
  if (differing.empty()) return "";
  return "Parts of the image differ by more than noise for " +
         NamesText(runs, differing) + ".";
}

std::string ReferenceText(const SceneRuns& runs, const SceneAnalysis& analysis) {
  if (analysis.biased_alike.empty()) return "";
  return fmt::format(
      "The mean image of {} differs from the reference by more than noise, but not from "
      "those of the others: that points at the reference.",
      NamesText(runs, analysis.biased_alike));
}

std::string SuspectTilesText(const SceneAnalysis& analysis) {
  const std::size_t tiles = analysis.suspect_tiles.size();
  if (tiles == 0) return "";
  return fmt::format(
      "In {} tile{} of the image the strategies agree with each other and not with the "
      "reference, which is less sure there than it says.",
      tiles, tiles == 1 ? "" : "s");
}

}  // namespace

void AddSentence(const std::string& sentence, std::string& text) {
  text += (text.empty() || sentence.empty() ? "" : " ") + sentence;
}

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
  std::string text;
  AddSentence(ImagesText(runs, analysis), text);
  AddSentence(TilesText(runs, analysis), text);
  AddSentence(ReferenceText(runs, analysis), text);
  AddSentence(SuspectTilesText(analysis), text);
  return text;
}

}  // namespace lanelight
