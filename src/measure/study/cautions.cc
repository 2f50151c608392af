// What a reader of a ranking has to know before believing it.
#include <algorithm>
#include <cmath>

#include "src/base/core/machine_info.h"
#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

class Cautioner {
 public:
  Cautioner(const SceneRuns& runs, const StudyOptions& options,
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
    if (level.spp >= kLeastLargest || error < kSmallError) return;
    texts_.push_back(
        fmt::format("The ranking is at {} samples per pixel, where {} has an error of "
                    "{:.2g} %. Longer renders may rank otherwise: use --spp up to {} or "
                    "more, or a larger --budget.",
                    level.spp, NameOf(analysis_.baseline), 100 * error, kLeastLargest));
  }

  // Level of that sample count with all repetitions; null without one.
  const stat::Level* LevelOf(std::size_t i, std::uint64_t spp) const {
    const StrategyAnalysis& s = Of(i);
    for (std::size_t k = 0; k < s.levels.size(); ++k) {
      const bool whole = s.levels[k].repetitions == s.AtLevel().repetitions;
      if (s.levels[k].spp == spp && whole) return &s.costs[k];
    }
    return nullptr;
  }

  static std::vector<stat::Cost> CostsOf(const stat::Level& level) {
    std::vector<stat::Cost> costs;
    for (std::size_t r = 0; r < level.error.size(); ++r) {
      costs.push_back({std::max(0.0, level.error[r]), level.seconds[r]});
    }
    return costs;
  }

  // `other` is the more efficient at that sample count, beyond doubt.
  bool Beats(std::size_t other, std::size_t one, std::uint64_t spp) const {
    const stat::Level *a = LevelOf(one, spp), *b = LevelOf(other, spp);
    if (a == nullptr || b == nullptr || a->error.size() != b->error.size()) return false;
    return stat::EfficiencyRatio(CostsOf(*a), CostsOf(*b), options_.confidence).low > 1;
  }

  // The first is behind the winner at the count that is compared, and before it at a
  // smaller one: both beyond doubt.
  void ChangedRanks() {
    const std::size_t winner = analysis_.ranking.front();
    const std::uint64_t at = Of(winner).AtLevel().spp;
    for (std::size_t k = Of(winner).at; k-- > 0;) {
      const std::uint64_t spp = Of(winner).levels[k].spp;
      for (const std::size_t other : analysis_.ranking) {
        if (other == winner || !Beats(winner, other, at) || !Beats(other, winner, spp)) {
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
      texts_.push_back(fmt::format(
          "The load of a machine before the start, {:.2f}, exceeds its {:.3g} "
          "cores: times, and so efficiencies, may be off.",
          *machine.load, *CoresAtATime(machine)));
    }
  }

  const SceneRuns& runs_;
  const StudyOptions& options_;
  const SceneAnalysis& analysis_;
  std::vector<std::string> texts_;
};

}  // namespace

std::vector<std::string> Cautions(const SceneRuns& runs, const StudyOptions& options,
                                  const SceneAnalysis& analysis) {
  return Cautioner(runs, options, analysis).Texts();
}

}  // namespace lanelight
