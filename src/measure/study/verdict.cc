// The result of a study of one scene in a paragraph.
#include <algorithm>
#include <cmath>

#include "src/base/stat/values.h"
#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

class Writer {
 public:
  Writer(const SceneRuns& runs, const SceneAnalysis& analysis)
      : runs_(runs), analysis_(analysis) {}

  std::string Text() {
    if (analysis_.ranking.empty()) return "No strategy has finished a render.";
    Winner();
    Target();
    Order();
    Warnings();
    return text_;
  }

 private:
  const std::string& NameOf(std::size_t i) const {
    return runs_.strategies[i].named.name;
  }
  const StrategyAnalysis& Of(std::size_t i) const { return analysis_.strategies[i]; }
  void Append(const std::string& sentence) { AddSentence(sentence, text_); }

  std::string List(const std::vector<std::size_t>& indices) const {
    return NamesText(runs_, indices, indices.size());
  }

  void Winner() {
    const std::size_t best = analysis_.ranking.front();
    const Interval& gain = *Of(best).efficiency;
    if (!std::isfinite(gain.value) || Of(best).AtLevel().relmse.value <= 0) {
      return Append(
          "No strategy differs from the reference, so there is no error to compare.");
    }
    std::vector<std::size_t> first;
    for (std::size_t i : analysis_.ranking) {
      if (Of(i).rank.best == 1) first.push_back(i);
    }
    const std::size_t repetitions = Of(best).AtLevel().repetitions;
    if (repetitions < 3) {
      return Append(fmt::format(
          "No ranking: {} repetition{} too few for intervals; use 3 or more. In these "
          "renders {} is the most efficient, with {} times the efficiency of {}.",
          repetitions, repetitions == 1 ? " is" : "s are", NameOf(best),
          EstimateText(gain), NameOf(analysis_.baseline)));
    }
    const std::string amount =
        best == analysis_.baseline
            ? "the baseline"
            : fmt::format("{} times the efficiency of {}", EstimateText(gain),
                          NameOf(analysis_.baseline));
    if (best == analysis_.baseline && first.size() == 1) {
      return Append(
          fmt::format("{} (the baseline) is the most efficient strategy.", NameOf(best)));
    }
    if (first.size() == 1) {
      return Append(
          fmt::format("{} is the most efficient strategy: {}.", NameOf(best), amount));
    }
    Append(
        fmt::format("{} is the most efficient strategy in these renders ({}), but {} not "
                    "significantly less efficient (all pairs tested together).",
                    NameOf(best), amount, Others(first)));
  }

  // Returns e.g. "A and B are" or "27 others are".
  std::string Others(const std::vector<std::size_t>& first) const {
    std::vector<std::size_t> others;
    for (std::size_t i : first) {
      if (i != analysis_.ranking.front()) others.push_back(i);
    }
    if (others.size() == 1) return NameOf(others.front()) + " is";
    if (others.size() > kMaxNames) return fmt::format("{} others are", others.size());
    return List(others) + " are";
  }

  void Target() {
    const std::size_t best = analysis_.ranking.front();
    const auto& mine = Of(best).to_target;
    const auto& base = Of(analysis_.baseline).to_target;
    if (!mine || !base || best == analysis_.baseline) return;
    Append(
        fmt::format("To reach a relative MSE of {:.3g}, it takes {:.3g} s of processor "
                    "time ({:.3g} spp{}); {} takes {:.3g} s ({:.3g} spp{}).",
                    analysis_.target_relmse, mine->seconds.value, mine->samples.value,
                    mine->extrapolated ? " (extrapolated)" : "",
                    NameOf(analysis_.baseline), base->seconds.value, base->samples.value,
                    base->extrapolated ? " (extrapolated)" : ""));
  }

  void Order() {
    const auto& order = Of(analysis_.ranking.front()).order;
    if (!order) return;
    Append(fmt::format("Its RMSE falls with the number of samples to the power {}{}.",
                       EstimateText(*order),
                       order->HasBounds() && order->high < -0.5
                           ? ", faster than independent samples"
                           : ""));
  }

  void TrimmedWinner() {
    const auto better = [&](std::size_t a, std::size_t b) {
      return Of(a).efficiency_trimmed->value < Of(b).efficiency_trimmed->value;
    };
    const std::size_t best = *std::ranges::max_element(analysis_.ranking, better);
    if (best == analysis_.baseline) return;
    Append(
        fmt::format("Without the worst 1 % of the pixels, {} is the most efficient: {} "
                    "times the efficiency of {}.",
                    NameOf(best), EstimateText(*Of(best).efficiency_trimmed),
                    NameOf(analysis_.baseline)));
  }

  void Warnings() {
    Append(CalibrationText(runs_, analysis_));
    std::vector<std::size_t> heavy, failed;
    for (std::size_t i = 0; i < analysis_.strategies.size(); ++i) {
      if (Of(i).heavy_tailed) heavy.push_back(i);
      if (runs_.strategies[i].status == RunStatus::kFailed) failed.push_back(i);
    }
    if (!heavy.empty()) {
      Append(
          fmt::format("Rare bright samples cause much of the error of {}: its intervals "
                      "are unreliable, and bias cannot be tested.",
                      NamesText(runs_, heavy)));
      TrimmedWinner();
    }
    Append(BiasText(runs_, analysis_));
    if (!failed.empty()) Append("Failed: " + List(failed) + ".");
    if (Of(analysis_.ranking.front()).AtLevel().ReferenceLimited()) {
      Append(
          "The reference is too noisy for the smallest errors: its own noise is more "
          "than half of them.");
    }
    if (runs_.interrupted) Append("The study was interrupted; --resume continues it.");
  }

  const SceneRuns& runs_;
  const SceneAnalysis& analysis_;
  std::string text_;
};

}  // namespace

std::string Verdict(const SceneRuns& runs, const SceneAnalysis& analysis) {
  return Writer(runs, analysis).Text();
}

}  // namespace lanelight
