#include "src/advise/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/core/check.h"
#include "src/advise/candidates.h"
#include "src/advise/rare_samples.h"
#include "src/advise/window_errors.h"

namespace lanelight {
namespace {

// Of the pilot's time; what these leave is for combinations of changes.
constexpr double kSingleChanges = 0.45, kRareSamples = 0.3;
// Against rare bright samples: guides paths to where light may come from.
constexpr const char* kRareChange = "roulette=adjoint";
constexpr const char* kRareMeaning = "rare bright samples carry the error";
constexpr std::uint64_t kRareSeed = 1000;  // the windows' seeds are below
// It must be this much better on the whole image, which a few samples measure badly.
constexpr double kRareMargin = 1.5;
// Changes that may be worth combining.
constexpr double kPromising = 1.03;
constexpr std::size_t kMostCombinations = 2;

class Adviser {
 public:
  Adviser(Job& job, const AdviceOptions& options) : job_(job), options_(options) {
    LL_CHECK(options.seconds > 0 && options.share > 0 && options.share < 1);
  }

  Advice Run() {
    const auto start = std::chrono::steady_clock::now();
    const double budget = options_.share * options_.seconds;
    std::vector<Candidate> all = CandidatesFor(job_.scene, job_.plan.options);
    const std::size_t single = Compare(all, budget * kSingleChanges, "");
    Candidate best = all[single];
    if (single > 0 && !advice_.interrupted) {
      std::vector<Candidate> combined = Combinations(all, best);
      const double left = budget * (1 - kRareSamples) - advice_.pilot_seconds;
      if (combined.size() > 1) best = combined[Compare(combined, left, best.changes)];
    }
    if (!advice_.interrupted) {
      CheckOnWholeImage(budget * kRareSamples, all.front(), best);
    }
    advice_.chosen = best.strategy;
    advice_.why = Why(best);
    Use(best.strategy);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    advice_.pilot_seconds = taken.count();
    job_.seconds = std::max(options_.seconds - taken.count(), 0.01 * options_.seconds);
    return advice_;
  }

 private:
  // Runs the pilot over those that the scene takes, the first being the default; returns
  // the index of the best and appends all of them to the advice.
  std::size_t Compare(const std::vector<Candidate>& all, double seconds,
                      const std::string& relative_to) {
    std::vector<std::size_t> taken;
    std::vector<Strategy> strategies;
    std::vector<double> margins;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].refused.empty()) continue;
      taken.push_back(i);
      strategies.push_back(all[i].strategy);
      margins.push_back(all[i].margin);
    }
    HalvingOptions halving;
    halving.seconds = seconds;
    const HalvingResult result =
        Halve(margins, WindowRenderer(job_, strategies, options_.stop), halving);
    advice_.pilot_seconds += result.seconds;
    advice_.interrupted |= result.interrupted;
    double windows = 0;
    for (const CandidateOutcome& c : result.candidates) windows += double(c.windows);
    if (windows > 0) sample_seconds_ = result.seconds / (windows * kWindowSamples);
    // The first of a second comparison is in the advice already.
    std::size_t next = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      CandidateOutcome outcome;
      outcome.status = CandidateStatus::kRefused;
      outcome.reason = all[i].refused;
      if (next < taken.size() && taken[next] == i) outcome = result.candidates[next++];
      if (i == 0 && !relative_to.empty()) continue;
      advice_.candidates.push_back({ToText(all[i].strategy), all[i].changes,
                                    all[i].meaning, outcome, relative_to});
    }
    const std::size_t best = taken[result.chosen];
    if (best > 0 && !relative_to.empty()) Demote(relative_to);
    return best;
  }

  // Renders the whole image with the best strategy, the default, and the change that
  // helps where rare bright samples carry the error: windows show too few of these to
  // tell.
  void CheckOnWholeImage(double seconds, const Candidate& usual, Candidate& best) {
    std::vector<Candidate> others = {
        usual, {Changed(usual.strategy, kRareChange), kRareChange, kRareMeaning, 0, ""}};
    std::erase_if(others,
                  [&](const Candidate& c) { return c.strategy == best.strategy; });
    WholeImage own;
    std::vector<WholeImage> images(others.size());
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t seed = job_.seed;
    double taken = 0;
    double of_round = double(1 + others.size()) * kRareSpp *
                      double(job_.window.pixels()) * sample_seconds_;
    for (int round = 1; of_round > 0 && taken + of_round <= seconds; ++round) {
      const std::uint64_t round_seed =
          seed + kRareSeed + static_cast<std::uint64_t>(round);
      bool done = AddWholeImage(job_, best.strategy, round_seed, options_.stop, own);
      for (std::size_t i = 0; i < others.size() && done; ++i) {
        done =
            AddWholeImage(job_, others[i].strategy, round_seed, options_.stop, images[i]);
      }
      advice_.interrupted |= !done;
      if (!done) return;
      const std::chrono::duration<double> passed =
          std::chrono::steady_clock::now() - start;
      taken = passed.count();
      of_round = taken / round;
    }
    for (std::size_t i = 0; i < others.size(); ++i) {
      const double gain = RareGain(own, images[i]);
      if (gain <= std::max(kRareMargin, advice_.rare_gain)) continue;
      advice_.rare_gain = gain;
      best = others[i];
    }
    if (advice_.rare_gain > 0) Replace(best);
  }

  // The windows' choice gives way to what the whole image shows.
  void Replace(const Candidate& best) {
    for (AdvisedCandidate& c : advice_.candidates) {
      if (c.outcome.status == CandidateStatus::kChosen) {
        c.outcome.status = CandidateStatus::kKept;
        c.outcome.reason = "rare bright samples carry its error on the whole image";
      }
      if (c.changes == best.changes) {
        c.outcome.status = CandidateStatus::kChosen;
        c.outcome.reason = "more efficient on the whole image";
      }
    }
  }

  // The best single change gives way to a combination.
  void Demote(const std::string& changes) {
    for (AdvisedCandidate& c : advice_.candidates) {
      if (c.changes != changes) continue;
      c.outcome.status = CandidateStatus::kKept;
      c.outcome.reason = "a combination with another change is certainly more efficient";
    }
  }

  // The winner, and with it the changes of other axes that looked better than none.
  std::vector<Candidate> Combinations(const std::vector<Candidate>& all,
                                      const Candidate& winner) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t i = 1; i < all.size(); ++i) {
      const CandidateOutcome& outcome = advice_.candidates[i].outcome;
      if (outcome.rounds == 0 || AxisOf(all[i].changes) == AxisOf(winner.changes)) {
        continue;
      }
      const double score = outcome.Score();
      if (score > kPromising + all[i].margin) others.emplace_back(-score, i);
    }
    std::sort(others.begin(), others.end());
    if (others.size() > kMostCombinations) others.resize(kMostCombinations);
    std::vector<Candidate> out = {winner};
    for (const auto& [score, i] : others) {
      Candidate both = all[i];
      both.strategy = Changed(winner.strategy, all[i].changes);
      both.changes = winner.changes + "," + all[i].changes;
      out.push_back(both);
    }
    return out;
  }

  std::string Why(const Candidate& best) const {
    if (advice_.interrupted) return "the pilot was interrupted";
    const auto measured = [](const AdvisedCandidate& c) { return c.outcome.rounds > 0; };
    if (std::none_of(advice_.candidates.begin(), advice_.candidates.end(), measured)) {
      return "the pilot's time was too short to compare strategies: the default";
    }
    if (best.changes.empty()) {
      return "no change is certainly more efficient than the default strategy";
    }
    if (advice_.rare_gain > 0) {
      return fmt::format(
          "rare bright samples carry the error: on the whole image {} is about {:.2g} "
          "times "
          "as efficient as what is best without them",
          best.changes.empty() ? "the default" : best.changes, advice_.rare_gain);
    }
    for (const AdvisedCandidate& c : advice_.candidates) {
      if (c.changes != best.changes) continue;
      const Interval& e = c.outcome.efficiency;
      const std::string bounds =
          e.HasBounds() ? fmt::format(" [{:.3g}, {:.3g}]", e.low, e.high) : "";
      return fmt::format(
          "{} is {:.3g}{} times as efficient as {} ({})", best.changes, e.value, bounds,
          c.relative_to.empty() ? "the default strategy" : c.relative_to, best.meaning);
    }
    return "";
  }

  void Use(const Strategy& strategy) {
    job_.spp = 0;
    SetStrategy(job_, strategy);
  }

  Job& job_;
  const AdviceOptions& options_;
  Advice advice_;
  double sample_seconds_ = 0;  // wall clock of one sample in the windows; 0: not known
};

nlohmann::json Finite(double x) {
  return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr);
}

}  // namespace

Advice Advise(Job& job, const AdviceOptions& options) {
  return Adviser(job, options).Run();
}

nlohmann::json ToJson(const Advice& advice) {
  nlohmann::json candidates = nlohmann::json::array();
  for (const AdvisedCandidate& c : advice.candidates) {
    const Interval& e = c.outcome.efficiency;
    nlohmann::json efficiency = nullptr;
    if (c.outcome.rounds > 0) {
      efficiency = {
          {"value", Finite(e.value)}, {"low", Finite(e.low)}, {"high", Finite(e.high)}};
    }
    candidates.push_back({{"strategy", c.strategy},
                          {"changes", c.changes},
                          {"meaning", c.meaning},
                          {"status", Name(c.outcome.status)},
                          {"reason", c.outcome.reason},
                          {"efficiency", efficiency},
                          {"efficiency_all_pixels",
                           c.outcome.rounds > 0 ? Finite(c.outcome.with_all_pixels)
                                                : nlohmann::json(nullptr)},
                          {"relative_to", c.relative_to},
                          {"rounds", c.outcome.rounds},
                          {"windows", c.outcome.windows}});
  }
  return {{"candidates", candidates},
          {"chosen", ToText(advice.chosen)},
          {"why", advice.why},
          {"pilot_seconds", advice.pilot_seconds},
          {"rare_gain", Finite(advice.rare_gain)},
          {"interrupted", advice.interrupted}};
}

}  // namespace lanelight
