#include "src/measure/advise/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/base/stat/values.h"
#include "src/render/run/run_strategy.h"
#include "src/render/train/strategy_trial.h"

namespace lanelight {
namespace {

// Fractions of the trial for its rounds: all candidates; those that may be better; the
// best two; the best.
constexpr double kProbe = 0.15, kFirst = 0.25, kSecond = 0.2, kLast = 0.25;
// Fraction of the trial for path reuse and light subpaths with the chosen strategy.
constexpr double kTiles = 0.15;
// Samples that a candidate needs; a short trial omits candidates instead.
constexpr std::uint64_t kMinSamples = 4096;
constexpr std::size_t kBest = 2;  // tried again, and their combination
// Gain from which a change stays in the trial.
constexpr double kMinTrialGain = 1.03;
// A trial is ended if it takes this factor of its planned processor time, on two
// processors; but not in the first second, in which much runs for the first time. Advice
// then depends on the machine, but not on other programs.
constexpr double kTimeoutFactor = 3, kProcessors = 2, kFirstSecond = 1;
// Assumed rays per sample before one is traced.
constexpr double kTypicalRays = 8;
constexpr double kNormal95 = 1.645;
// Factor on the standard errors of stated intervals, since the sampled pixels may miss
// those that dominate the error. Of 555 intervals (90 %) on 26 scenes 89 % held with the
// factor, and 85 % without it.
constexpr double kExtraUncertainty = 1.5;
// Samples per pixel. Only many samples show the gain of stratification; the trial also
// needs about kPixels pixels.
constexpr std::uint64_t kMinSpp = 32, kMaxTrialSpp = 512, kPixels = 256;

// A candidate in the trial.
struct Tried {
  std::size_t index = 0;  // in Advice::candidates
  TriedStrategy entry;    // result of the last round
};

// Returns a gain with its 90 % interval, which includes the scatter of the cost of rays
// between scenes. `minimum`: the lower end without noise.
Interval WithUncertainty(const TrialGain& gain, double minimum,
                         double price_uncertainty) {
  const double error =
      kNormal95 * std::hypot(kExtraUncertainty * gain.standard_error, price_uncertainty);
  return {std::exp(gain.log), std::exp(minimum - error), std::exp(gain.maximum + error)};
}

std::uint32_t SppFor(std::uint64_t samples) {
  return std::uint32_t(
      std::clamp(std::bit_floor(samples / kPixels), kMinSpp, kMaxTrialSpp));
}

class Adviser {
 public:
  Adviser(const Job& job, const AdviceOptions& options)
      : job_(job),
        options_(options),
        pilot_(options.pilot > 0 ? options.pilot : kTrialFraction * options.seconds),
        training_{.stop = options.stop},
        trial_(job.scene, training_, SeedOf(job.seed, 0), PlannedSamples()) {
    LL_CHECK(options.seconds > 0);
  }

  Advice Run() {
    all_ = CandidatesFor(job_.scene, job_.plan.options);
    std::vector<Tried> tried = FirstCandidates();
    if (tried.size() > 1 && RunRound(tried, 0)) {
      DropWorseCandidates(tried);
      if (tried.size() > 1 && RunRound(tried, kFirst)) RunSecondRound(tried);
    }
    if (advice_.rays > 0 && !advice_.interrupted) TryOnTiles(tried);
    Conclude();
    return advice_;
  }

 private:
  // Candidates train as if for a quarter of the render, which is part of the trial.
  std::uint64_t PlannedSamples() const {
    return std::uint64_t(options_.seconds * kRaysPerSecond / kTypicalRays / 4);
  }
  // Returns the samples of each candidate in a round with this fraction of the trial. The
  // cost of a new combination is that of its first part.
  std::uint64_t SamplesFor(const std::vector<Tried>& tried, double fraction) const {
    double rays = 0;
    for (const Tried& t : tried) {
      const bool known = !t.entry.measure.variances.empty();
      rays += (known ? t : tried[1]).entry.measure.cost;
    }
    if (rays == 0) return 0;
    return std::uint64_t(fraction * pilot_ * kRaysPerSecond / rays);
  }

  // Returns the candidates of the first round: as many as can have kMinSamples samples.
  std::vector<Tried> FirstCandidates() {
    std::vector<Tried> tried(1);
    for (std::size_t i = 1; i < all_.size(); ++i) {
      if (all_[i].status != CandidateStatus::kRefused) tried.push_back({i, {}});
    }
    const double of_all = double(kMinSamples) * kTypicalRays * double(tried.size());
    advice_.seconds_to_try = of_all / (kProbe * kRaysPerSecond);
    const double fraction = std::min(1.0, pilot_ / advice_.seconds_to_try);
    const auto reached = std::size_t(fraction * double(tried.size()));
    for (std::size_t i = std::max<std::size_t>(reached, 1); i < tried.size(); ++i) {
      all_[tried[i].index].reason = "the trial ran out of time";
    }
    tried.resize(reached < 2 ? 1 : reached);
    return tried;
  }

  bool RunRound(std::vector<Tried>& tried, double fraction) {
    const std::uint64_t samples = std::max(SamplesFor(tried, fraction), kMinSamples);
    advice_.interrupted |= IsTooSlow() || !TryAll(tried, samples);
    if (advice_.interrupted) return false;
    for (const Tried& t : tried) {
      AdvisedCandidate& advised = all_[t.index];
      advised.samples += samples;
      advised.status = CandidateStatus::kKept;
      if (t.index > 0) advised.efficiency = EfficiencyOf(t);
    }
    advice_.rays = trial_.spent().rays;
    return true;
  }

  // Tries the default first, on pixels of no other round. Returns false if stopped.
  bool TryAll(std::vector<Tried>& tried, std::uint64_t samples) {
    trial_.Begin(samples, SppFor(samples), round_++);
    for (Tried& t : tried) {
      const AdvisedCandidate& c = all_[t.index];
      if (!t.entry.has_learned) {
        t.entry = PrepareTrial(PreparedFor(c), job_.plan.options, c.changes, c.price);
      }
      if (!trial_.Try(t.entry, tried.front().entry)) return false;
    }
    return true;
  }

  // Returns the scene prepared for the candidate, without roulette, which StrategyTrial
  // changes in the plan.
  PreparedScene PreparedFor(const AdvisedCandidate& candidate) const {
    Strategy prepared = candidate.strategy;
    prepared.decide = Decide::kPilot;  // with the tables of all that trials compare
    const Strategy baseline;
    prepared.roulette = baseline.roulette;
    prepared.termination = baseline.termination;
    prepared.floor = baseline.floor;
    prepared.first = baseline.first;
    prepared.scale = baseline.scale;
    return WithStrategy(job_.scene, prepared);
  }

  // Returns the efficiency by the last round, with the uncertainty of pixels that were
  // omitted.
  Interval EfficiencyOf(const Tried& t) const {
    TrialGain gain = t.entry.EfficiencyGain();
    const double by_all = GainOf(t.entry.measure, t.entry.baseline).log;
    gain.standard_error = std::hypot(gain.standard_error, gain.log - by_all);
    return WithUncertainty(gain, t.entry.Gain().log, all_[t.index].price_uncertainty);
  }

  // Drops, after few samples, candidates that are not expected to become the best.
  void DropWorseCandidates(std::vector<Tried>& tried) {
    std::erase_if(tried, [&](const Tried& t) {
      const bool misses = t.entry.MissesLight(), worse = EfficiencyOf(t).high < 1;
      if (t.index == 0 || !(misses || worse)) return false;
      Drop(t, misses ? "finds less light than the default: it misses rare bright samples"
                     : "clearly less efficient than the default");
      return true;
    });
  }

  bool IsTooSlow() const {
    return watch_.CpuSeconds() > kFirstSecond + kTimeoutFactor * kProcessors * pilot_;
  }

  static double Score(const Tried& t) { return t.entry.Gain().log; }

  // Tries the default, the best two of the first round, and their combination.
  void RunSecondRound(std::vector<Tried>& tried) {
    const auto better = [](const Tried& a, const Tried& b) {
      return Score(a) > Score(b);
    };
    std::sort(tried.begin() + 1, tried.end(), better);
    while (tried.size() > 1 &&
           (tried.size() > 1 + kBest || Score(tried.back()) < std::log(kMinTrialGain))) {
      Drop(tried.back(), "less efficient than other candidates");
      tried.pop_back();
    }
    if (tried.size() < 2) return;
    if (tried.size() == 1 + kBest) Combine(tried);
    if (tried.size() > 2 && !RunRound(tried, kSecond)) return;
    std::iter_swap(tried.begin() + 1,
                   std::min_element(tried.begin() + 1, tried.end(), better));
    tried.resize(2);
    if (!RunRound(tried, kLast)) return;
    const Tried& last = tried.back();
    if (last.entry.SignificantLogGain(kMinChangeGain, kNormal95) > 0)
      chosen_ = last.index;
    unseen_ = chosen_ == 0 && last.entry.IsCarriedByFew() ? last.index : 0;
  }

  void Drop(const Tried& t, const char* reason) {
    all_[t.index].status = CandidateStatus::kDropped;
    all_[t.index].reason = reason;
  }

  void Combine(std::vector<Tried>& tried) {
    const auto both = Together(all_[tried[1].index], all_[tried[2].index]);
    if (!both) return;
    all_.push_back(*both);
    tried.push_back({all_.size() - 1, {}});
  }

  void TryOnTiles(std::vector<Tried>& tried) {
    const Tried& baseline = tried.front();
    const Tried& chosen = chosen_ == 0 ? baseline : tried.back();
    const Tried& base = chosen.entry.splits ? baseline : chosen;
    const double gain = chosen_ == 0 ? 1 : EfficiencyOf(chosen).value;
    // A sample with a change costs 1.25 to 1.5 times as much as one without.
    const auto samples = std::uint64_t(kTiles * pilot_ * kRaysPerSecond /
                                       (3.75 * base.entry.measure.cost));
    const std::vector<TriedOnTiles> on_tiles =
        trial_.TryOnTiles(baseline.entry, chosen.entry, gain, samples);
    const TriedOnTiles* const best = BestOf(on_tiles);
    const Tried beside = base;
    for (const TriedOnTiles& t : on_tiles) {
      AddOnTiles(beside, t, samples);
      if (&t == best) chosen_ = all_.size() - 1;
    }
    advice_.rays = trial_.spent().rays;
  }

  // Adds `base` combined with a change that was tried on tiles.
  void AddOnTiles(const Tried& base, const TriedOnTiles& tried, std::uint64_t samples) {
    AdvisedCandidate both = WithAddedChanges(all_[base.index], tried.candidate.changes);
    both.meaning = tried.candidate.reason;
    const Interval baseline = base.index == 0 ? Interval{1, 1, 1} : EfficiencyOf(base);
    const Interval more = WithUncertainty(tried.per_pixel, tried.per_pixel.minimum,
                                          tried.candidate.price_uncertainty);
    both.efficiency = {baseline.value * more.value, baseline.low * more.low,
                       baseline.high * more.high};
    both.status = CandidateStatus::kDropped;
    both.reason = tried.has_gain_per_pixel
                      ? "more efficient per pixel, less efficient after a filter"
                      : "not clearly better";
    both.samples = samples;
    all_.push_back(both);
  }

  void Conclude() {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      AdvisedCandidate& c = all_[i];
      if (i == chosen_) {
        c.status = CandidateStatus::kChosen;
        c.reason = i == 0                 ? "no other is clearly more efficient"
                   : c.efficiency.low > 1 ? "clearly more efficient than the default"
                                          : "probably more efficient than the default";
      } else if (c.status == CandidateStatus::kKept) {
        c.reason =
            i == 0 ? all_[chosen_].efficiency.low > 1
                         ? "another candidate is clearly more efficient"
                         : "another candidate is probably more efficient"
            : i == unseen_
                ? "few bright samples dominate its error, so the trial is inconclusive"
            : chosen_ == 0 ? "not clearly better than the default"
                           : "not the best candidate";
      }
    }
    const AdvisedCandidate& best = all_[chosen_];
    advice_.chosen = best.strategy;
    advice_.why = Why(best);
    advice_.pilot_seconds = watch_.Seconds();
  }

  std::string Why(const AdvisedCandidate& best) const {
    const bool stopped = options_.stop != nullptr && *options_.stop;
    if (stopped) return "the trial was interrupted";
    if (advice_.interrupted) {
      return fmt::format(
          "the trial exceeded {:g} times its planned processor time, so the default is "
          "used",
          kTimeoutFactor);
    }
    if (advice_.rays == 0) {
      return "the trial is too short to compare strategies, so the default is used";
    }
    if (chosen_ == 0) {
      return "no change is clearly more efficient than the default strategy";
    }
    return fmt::format("{} is {} times as efficient as the default strategy ({})",
                       best.changes, EstimateText(best.efficiency), best.meaning);
  }

  const Job& job_;
  const AdviceOptions& options_;
  const Stopwatch watch_;
  const double pilot_;  // seconds of kRaysPerSecond
  const TrainingOptions training_;
  StrategyTrial trial_;
  std::uint64_t round_ = 0;  // of rounds
  std::size_t chosen_ = 0, unseen_ = 0;
  Advice advice_;
  std::vector<AdvisedCandidate>& all_ = advice_.candidates;
};

}  // namespace

bool IsUncertain(const Interval& efficiency) {
  return efficiency.HasBounds() && !(efficiency.high <= kMaxUncertainty * efficiency.low);
}

Advice Advise(const Job& job, const AdviceOptions& options) {
  const ThreadLimit threads(job.settings.threads);
  return Adviser(job, options).Run();
}

Job WithAdvice(Job job, const Advice& advice, const AdviceOptions& options) {
  job.spp = 0;
  job.seconds = std::max(options.seconds - advice.pilot_seconds, 0.01 * options.seconds);
  return WithStrategy(std::move(job), advice.chosen);
}

nlohmann::json ToJson(const Advice& advice) {
  nlohmann::json candidates = nlohmann::json::array();
  for (const AdvisedCandidate& c : advice.candidates) {
    candidates.push_back({{"strategy", ToText(c.strategy)},
                          {"changes", c.changes},
                          {"meaning", c.meaning},
                          {"status", Name(c.status)},
                          {"reason", c.reason},
                          {"efficiency", c.samples > 0 && !IsUncertain(c.efficiency)
                                             ? IntervalJson(c.efficiency)
                                             : nullptr},
                          {"samples", c.samples}});
  }
  return {{"candidates", candidates},  {"chosen", ToText(advice.chosen)},
          {"why", advice.why},         {"pilot_seconds", advice.pilot_seconds},
          {"pilot_rays", advice.rays}, {"interrupted", advice.interrupted}};
}

}  // namespace lanelight
