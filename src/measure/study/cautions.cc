// Cautions about a ranking.

#include <algorithm>
#include <cmath>

#include "src/base/core/machine_info.h"
#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

class CautionFinder {
 public:
  CautionFinder(const SceneRuns& runs, const StudyOptions& options,
                const SceneAnalysis& analysis)
      : runs_(runs), options_(options), analysis_(analysis) {}

  std::vector<std::string> Texts() {
    if (!analysis_.ranking.empty()) {
      SmallLevel();
      ChangedRanks();
    }
    BusyMachines();
    return std::move(texts_);
  }

 private:
  const StrategyAnalysis& Of(std::size_t i) const { return analysis_.strategies[i]; }
  const std::string& NameOf(std::size_t i) const {
    return runs_.strategies[i].named.name;
  }

  void SmallLevel() {
    const LevelAnalysis& level = Of(analysis_.baseline).AtLevel();
    const double error = std::sqrt(std::max(0.0, level.relmse.value));
    if (level.spp >= kMinLargest || error < kSmallError) return;
    texts_.push_back(fmt::format(
        "The ranking is at {} samples per pixel, where {} has an error of "
        "{:.2g} %. Longer renders may rank differently: use --spp up to {} or "
        "more, or a larger --budget.",
        level.spp, NameOf(analysis_.baseline), 100 * error, kMinLargest));
  }

  // Returns the level of that sample count with all repetitions; null without one.
  const stat::Level* LevelOf(std::size_t i, std::uint64_t spp) const {
    const StrategyAnalysis& s = Of(i);
    for (std::size_t k = 0; k < s.levels.size(); ++k) {
      const bool whole = s.levels[k].repetitions == s.AtLevel().repetitions;
      if (s.levels[k].spp == spp && whole) return &s.costs[k];
    }
    return nullptr;
  }

  // Returns whether `other` is significantly more efficient at that sample count.
  bool RanksAbove(std::size_t other, std::size_t one, std::uint64_t spp) const {
    const stat::Level *a = LevelOf(one, spp), *b = LevelOf(other, spp);
    if (a == nullptr || b == nullptr || a->error.size() != b->error.size()) return false;
    const std::size_t n = a->error.size();
    return stat::EfficiencyRatio(CostsOf(*a, n), CostsOf(*b, n), options_.confidence)
               .low > 1;
  }

  // Reports a strategy that is significantly worse than the winner at the compared sample
  // count, and significantly better at a smaller one.
  void ChangedRanks() {
    const std::size_t winner = analysis_.ranking.front();
    const std::uint64_t at = Of(winner).AtLevel().spp;
    for (std::size_t k = Of(winner).at; k-- > 0;) {
      const std::uint64_t spp = Of(winner).levels[k].spp;
      for (const std::size_t other : analysis_.ranking) {
        if (other == winner || !RanksAbove(winner, other, at) ||
            !RanksAbove(other, winner, spp)) {
          continue;
        }
        texts_.push_back(fmt::format(
            "Ranks change with the number of samples: at {} samples per pixel "
            "{} is more efficient than {}, at {} it is less efficient.",
            spp, NameOf(other), NameOf(winner), at));
        return;
      }
    }
  }

  void BusyMachines() {
    for (const MachineInfo& machine : analysis_.machines) {
      if (!IsOverloaded(machine)) continue;
      texts_.push_back(
          fmt::format("The machine was busy before the start (load {:.2f}, {:.3g} "
                      "cores): times and efficiencies may be wrong.",
                      *machine.load, *CoresAtATime(machine)));
    }
  }

  const SceneRuns& runs_;
  const StudyOptions& options_;
  const SceneAnalysis& analysis_;
  std::vector<std::string> texts_;
};

// Heavy-tailed strategies are not tested.
bool HasHeavyTail(const SceneAnalysis& analysis) {
  return std::ranges::any_of(analysis.strategies,
                             [](const StrategyAnalysis& s) { return s.heavy_tailed; });
}

std::string ImagesText(const SceneRuns& runs, const SceneAnalysis& analysis) {
  if (!analysis.biased.empty()) {
    return fmt::format(
        "The mean image of {} differs from the reference by more than noise "
        "(significance level {:g}, all tests together).",
        NamesText(runs, analysis.biased), analysis.bias_level);
  }
  if (analysis.bias_tests == 0 || !analysis.biased_alike.empty()) return "";
  return fmt::format(
      "No {}mean image differs from the reference by more than noise ({} test{}).",
      HasHeavyTail(analysis) ? "other " : "", analysis.bias_tests,
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
      "those of the other strategies, so the reference may be wrong.",
      NamesText(runs, analysis.biased_alike));
}

std::string SuspectTilesText(const SceneAnalysis& analysis) {
  const std::size_t tiles = analysis.suspect_tiles.size();
  if (tiles == 0) return "";
  return fmt::format(
      "In {} tile{} of the image the strategies agree with each other but not with the "
      "reference, so its estimated variance is probably too small there.",
      tiles, tiles == 1 ? "" : "s");
}

}  // namespace

std::vector<std::string> Cautions(const SceneRuns& runs, const StudyOptions& options,
                                  const SceneAnalysis& analysis) {
  return CautionFinder(runs, options, analysis).Texts();
}

void AddSentence(const std::string& sentence, std::string& text) {
  text += (text.empty() || sentence.empty() ? "" : " ") + sentence;
}

std::string NamesText(const SceneRuns& runs, const std::vector<std::size_t>& strategies,
                      std::size_t max_names) {
  if (strategies.size() > max_names)
    return fmt::format("{} strategies", strategies.size());
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
