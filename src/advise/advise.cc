#include "src/advise/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/advise/trial.h"
#include "src/core/check.h"
#include "src/core/clock.h"

namespace lanelight {
namespace {

// Shares of the trial: a few samples of all candidates; those that may be better; the
// best again; the very best alone.
constexpr double kProbe = 0.15, kFirst = 0.25, kSecond = 0.2, kLast = 0.25;
// And of paths that serve their block, beside what has been chosen.
constexpr double kTiles = 0.15;
// Fewer samples say nothing of a candidate: rather leave candidates out.
constexpr std::uint64_t kLeastSamples = 4096;
constexpr std::size_t kBest = 2;  // that are tried again, beside what they make together
// Changes that may be worth combining, and going on with.
constexpr double kPromising = 1.03;
// A trial that takes so many times the processor time that it should, of two processors,
// is ended; but not in the first second, in which much is done for the first time. Advice
// then hangs on the machine, but not on what else runs on it.
constexpr double kPatience = 3, kProcessors = 2, kFirstSecond = 1;
// Rays of a sample, to plan by before one is traced.
constexpr double kUsualRays = 8;

class Adviser {
 public:
  Adviser(Job& job, const AdviceOptions& options)
      : job_(job),
        options_(options),
        pilot_(options.pilot > 0 ? options.pilot : kPilotShare * options.seconds),
        trial_(job, PlannedSamples(), options.stop) {
    LL_CHECK(options.seconds > 0);
  }

  Advice Run() {
    all_ = CandidatesFor(job_.scene, job_.plan.options);
    for (const Candidate& c : all_) Add(c);
    std::vector<TriedCandidate> tried = First();
    if (tried.size() > 1 && Round(tried, 0)) {
      DropWorse(tried);
      if (tried.size() > 1 && Round(tried, kFirst)) Second(tried);
    }
    if (advice_.rays > 0 && !advice_.interrupted) TryBlocks(tried);
    Conclude();
    return advice_;
  }

 private:
  // Candidates learn as if for a quarter of the render: what they learn from is part of
  // the trial.
  std::uint64_t PlannedSamples() const {
    return static_cast<std::uint64_t>(options_.seconds * kRaysPerSecond / kUsualRays / 4);
  }
  // Of each in a round with this share of the trial. What has not been tried yet, since
  // it is made of two others, is taken to cost what they do.
  std::uint64_t SamplesFor(const std::vector<TriedCandidate>& tried, double share) const {
    double rays = 0;
    for (const TriedCandidate& t : tried) {
      const bool known = !t.entry.measure.variances.empty();
      rays += (known ? t : tried[1]).entry.measure.cost;
    }
    if (rays == 0) return 0;
    return static_cast<std::uint64_t>(share * pilot_ * kRaysPerSecond / rays);
  }

  void Add(const Candidate& c) {
    AdvisedCandidate advised;
    advised.strategy = ToText(c.strategy);
    advised.changes = c.changes;
    advised.meaning = c.meaning;
    advised.reason = c.refused;
    if (!c.refused.empty()) advised.status = CandidateStatus::kRefused;
    advice_.candidates.push_back(advised);
  }

  // A few samples of each show what it costs, and what is clearly worse; then as many as
  // each can have the least number of samples. A trial that cannot try so few of all
  // tries what comes first.
  std::vector<TriedCandidate> First() {
    std::vector<TriedCandidate> tried = {{all_.front(), 0, {}, false}};
    for (std::size_t i = 1; i < all_.size(); ++i) {
      if (all_[i].refused.empty()) tried.push_back({all_[i], i, {}, false});
    }
    const double of_all = double(kLeastSamples) * kUsualRays * double(tried.size());
    advice_.seconds_to_try = of_all / (kProbe * kRaysPerSecond);
    const double share = std::min(1.0, pilot_ / advice_.seconds_to_try);
    const auto reached = static_cast<std::size_t>(share * double(tried.size()));
    for (std::size_t i = std::max<std::size_t>(reached, 1); i < tried.size(); ++i) {
      advice_.candidates[tried[i].index].reason = "the trial's time did not reach it";
    }
    tried.resize(reached < 2 ? 1 : reached);
    return tried;
  }

  bool Round(std::vector<TriedCandidate>& tried, double share) {
    const std::uint64_t samples = std::max(SamplesFor(tried, share), kLeastSamples);
    advice_.interrupted |= IsTooSlow() || !trial_.Round(tried, samples);
    if (advice_.interrupted) return false;
    for (const TriedCandidate& t : tried) {
      AdvisedCandidate& advised = advice_.candidates[t.index];
      advised.samples += samples;
      advised.status = CandidateStatus::kKept;
      if (t.index > 0) advised.efficiency = t.Efficiency();
    }
    advice_.rays = trial_.rays();
    return true;
  }

  // By few samples: what nobody would expect to be the best after more of them.
  void DropWorse(std::vector<TriedCandidate>& tried) {
    std::erase_if(tried, [&](const TriedCandidate& t) {
      const bool misses = t.entry.MissesLight(), worse = t.Efficiency().high < 1;
      if (t.index == 0 || !(misses || worse)) return false;
      Drop(t, misses
                  ? "finds less light than the default: what is missing is seldom, bright"
                  : "clearly less efficient than the default");
      return true;
    });
  }

  bool IsTooSlow() const {
    return ProcessCpuSeconds() - start_cpu_ >
           kFirstSecond + kPatience * kProcessors * pilot_;
  }

  static double Score(const TriedCandidate& t) { return t.entry.Gain().log; }

  // The default, the best of the first round, and what both of them make together.
  void Second(std::vector<TriedCandidate>& tried) {
    std::sort(tried.begin() + 1, tried.end(),
              [](const auto& a, const auto& b) { return Score(a) > Score(b); });
    while (tried.size() > 1 &&
           (tried.size() > 1 + kBest || Score(tried.back()) < std::log(kPromising))) {
      Drop(tried.back(), "less efficient than others after a round");
      tried.pop_back();
    }
    if (tried.size() < 2) return;
    if (tried.size() == 1 + kBest) Combine(tried);
    if (tried.size() > 2 && !Round(tried, kSecond)) return;
    const auto best = std::max_element(
        tried.begin() + 1, tried.end(),
        [](const auto& a, const auto& b) { return Score(a) < Score(b); });
    std::iter_swap(tried.begin() + 1, best);
    tried.resize(2);
    if (!Round(tried, kLast)) return;
    const TriedCandidate& last = tried.back();
    if (last.Beyond() > 0) chosen_ = last.index;
    unseen_ = chosen_ == 0 && last.entry.IsCarriedByFew() ? last.index : 0;
  }

  void Drop(const TriedCandidate& t, const char* reason) {
    AdvisedCandidate& advised = advice_.candidates[t.index];
    advised.status = CandidateStatus::kDropped;
    advised.reason = reason;
  }

  // Two changes of one axis do not go together.
  void Combine(std::vector<TriedCandidate>& tried) {
    const Candidate &a = tried[1].candidate, &b = tried[2].candidate;
    if (a.meaning == kOwnStrategy || b.meaning == kOwnStrategy ||
        AxisOf(a.changes) == AxisOf(b.changes)) {
      return;
    }
    Candidate both = a;
    both.strategy = Changed(a.strategy, b.changes);
    both.changes += "," + b.changes;
    both.meaning = "both pay";
    both.price *= b.price;
    both.price_spread = std::hypot(a.price_spread, b.price_spread);
    all_.push_back(both);
    Add(both);
    tried.push_back({both, all_.size() - 1, {}, false});
  }

  // Paths that split serve no others: there it is one or the other.
  void TryBlocks(std::vector<TriedCandidate>& tried) {
    TriedCandidate& chosen = chosen_ == 0 ? tried.front() : tried.back();
    const bool splits = chosen.candidate.strategy.Splits();
    TriedCandidate& base = splits ? tried.front() : chosen;
    const double must = splits ? chosen.Efficiency().value : kMustGain;
    // Half as many again since they cost more.
    const auto samples = static_cast<std::uint64_t>(kTiles * pilot_ * kRaysPerSecond /
                                                    (2.5 * base.entry.measure.cost));
    for (const TriedBlocks& blocks : trial_.Blocks(base, samples, must)) {
      Add(base, blocks);
      advice_.candidates.back().samples = samples;
      if (blocks.verdict.pays) chosen_ = all_.size() - 1;
    }
    advice_.rays = trial_.rays();
  }

  // What `base` makes together with the blocks.
  void Add(const TriedCandidate& base, const TriedBlocks& blocks) {
    Candidate both = base.candidate;
    both.strategy = Changed(both.strategy, blocks.changes);
    both.changes += (both.changes.empty() ? "" : ",") + std::string(blocks.changes);
    both.meaning = "pays where most of the noise is indirect light";
    all_.push_back(both);
    Add(both);
    AdvisedCandidate& advised = advice_.candidates.back();
    const Interval usual = base.index == 0 ? Interval{1, 1, 1} : base.Efficiency();
    const Interval more = EfficiencyOf(blocks.verdict);
    advised.efficiency = {usual.value * more.value, usual.low * more.low,
                          usual.high * more.high};
    advised.status = CandidateStatus::kDropped;
    advised.reason = blocks.verdict.pays_per_pixel
                         ? "gains by pixels, and loses after a filter"
                         : "not clearly better";
  }

  void Conclude() {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      AdvisedCandidate& c = advice_.candidates[i];
      if (i == chosen_) {
        c.status = CandidateStatus::kChosen;
        c.reason = i == 0 ? "no other is clearly more efficient"
                          : "clearly more efficient than the default";
      } else if (c.status == CandidateStatus::kKept) {
        c.reason = i == 0 ? "the default; another is clearly more efficient"
                   : i == unseen_
                       ? "few bright samples carry its error: a trial cannot tell"
                   : chosen_ == 0 ? "not clearly better than the default"
                                  : "not the best";
      }
    }
    const Candidate& best = all_[chosen_];
    advice_.chosen = best.strategy;
    advice_.why = Why(best);
    job_.spp = 0;
    SetStrategy(job_, best.strategy);
    const std::chrono::duration<double> taken = Clock::now() - start_;
    advice_.pilot_seconds = taken.count();
    job_.seconds = std::max(options_.seconds - taken.count(), 0.01 * options_.seconds);
  }

  std::string Why(const Candidate& best) const {
    const bool stopped = options_.stop != nullptr && *options_.stop;
    if (stopped) return "the trial was interrupted";
    if (advice_.interrupted) {
      return fmt::format(
          "the trial was ended after {:g} times the processor time that "
          "it should take: the default",
          kPatience);
    }
    if (advice_.rays == 0) {
      return "the trial's time is too short to compare strategies: the default";
    }
    if (chosen_ == 0) {
      return "no change is clearly more efficient than the default strategy";
    }
    const Interval& e = advice_.candidates[chosen_].efficiency;
    return fmt::format(
        "{} is {:.3g} [{:.3g}, {:.3g}] times as efficient as the default strategy ({})",
        best.changes, e.value, e.low, e.high, best.meaning);
  }

  using Clock = std::chrono::steady_clock;
  Job& job_;
  const AdviceOptions& options_;
  const Clock::time_point start_ = Clock::now();
  const double start_cpu_ = ProcessCpuSeconds();
  const double pilot_;  // seconds of kRaysPerSecond
  Trial trial_;
  std::vector<Candidate> all_;
  std::size_t chosen_ = 0, unseen_ = 0;
  Advice advice_;
};

nlohmann::json Finite(double x) {
  return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr);
}

}  // namespace

const char* Name(CandidateStatus status) {
  constexpr const char* kNames[] = {"chosen", "kept", "dropped", "skipped", "refused"};
  return kNames[static_cast<int>(status)];
}

Advice Advise(Job& job, const AdviceOptions& options) {
  return Adviser(job, options).Run();
}

nlohmann::json ToJson(const Advice& advice) {
  nlohmann::json candidates = nlohmann::json::array();
  for (const AdvisedCandidate& c : advice.candidates) {
    const Interval& e = c.efficiency;
    nlohmann::json efficiency = nullptr;
    if (c.samples > 0) {
      efficiency = {
          {"value", Finite(e.value)}, {"low", Finite(e.low)}, {"high", Finite(e.high)}};
    }
    candidates.push_back({{"strategy", c.strategy},
                          {"changes", c.changes},
                          {"meaning", c.meaning},
                          {"status", Name(c.status)},
                          {"reason", c.reason},
                          {"efficiency", efficiency},
                          {"samples", c.samples}});
  }
  return {{"candidates", candidates},  {"chosen", ToText(advice.chosen)},
          {"why", advice.why},         {"pilot_seconds", advice.pilot_seconds},
          {"pilot_rays", advice.rays}, {"interrupted", advice.interrupted}};
}

}  // namespace lanelight
