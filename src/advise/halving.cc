#include "src/advise/halving.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "src/core/check.h"
#include "src/stat/hypothesis.h"

namespace lanelight {
namespace {

using stat::Cost;

constexpr int kWarmUpWindows = 2;

constexpr std::size_t kMostBlocks = 16;

// A window's error, and its share of the time of its batch (counted over all rounds).
struct WindowCost {
  Cost cost;
  std::size_t batch = 0;
};

std::size_t Batches(std::span<const WindowCost> windows) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    count += i == 0 || windows[i].batch != windows[i - 1].batch;
  }
  return count;
}

// Means of at most 16 blocks of consecutive windows: whole batches, as the windows of one
// have one time. Consecutive windows cover the image, so that what is shown in them
// scatters less from block to block; and means of many are nearer to normal, and quicker
// to resample.
std::vector<Cost> Blocks(std::span<const WindowCost> windows) {
  const std::size_t batches = Batches(windows), count = std::min(batches, kMostBlocks);
  std::vector<Cost> blocks(count);
  std::vector<double> sizes(count);
  std::size_t batch = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    batch += i > 0 && windows[i].batch != windows[i - 1].batch;
    const std::size_t block = batch * count / batches;
    blocks[block].error += windows[i].cost.error;
    blocks[block].seconds += windows[i].cost.seconds;
    sizes[block] += 1;
  }
  for (std::size_t i = 0; i < count; ++i) {
    blocks[i].error /= sizes[i];
    blocks[i].seconds /= sizes[i];
  }
  return blocks;
}

// Error times seconds.
double Product(std::span<const WindowCost> windows) {
  double error = 0, seconds = 0;
  for (const WindowCost& w : windows) {
    error += w.cost.error;
    seconds += w.cost.seconds;
  }
  return error * seconds;
}

class Halving {
 public:
  Halving(const std::vector<double>& margins, const MeasureRound& measure,
          const HalvingOptions& options)
      : margins_(margins),
        measure_(measure),
        options_(options),
        records_(margins.size()) {
    LL_CHECK(!margins.empty());
    result_.candidates.resize(margins.size());
    for (std::size_t i = 1; i < margins.size(); ++i) waiting_.push_back(i);
  }

  HalvingResult Run() {
    if (!waiting_.empty() && WarmUp()) {
      while (!result_.interrupted && Admit()) {
        while (alive_.size() > 1 && Round()) Drop();
      }
    }
    for (std::size_t i : waiting_) {
      result_.candidates[i].reason = "the pilot's time did not reach it";
    }
    Choose();
    return result_;
  }

 private:
  struct Record {
    std::size_t first = 0;  // candidate 0 had so many windows before
    std::vector<WindowCost> all, robust;
  };

  double Left() const { return options_.seconds - result_.seconds; }

  // The first windows fill caches; the next show what a window takes. They do not count.
  bool WarmUp() {
    for (int i = 0; i < 2; ++i) {
      double elapsed = 0;
      result_.interrupted = measure_({0}, kWarmUpWindows, elapsed).empty();
      if (result_.interrupted) return false;
      result_.seconds += elapsed;
      window_seconds_ = std::max(elapsed / kWarmUpWindows, 1e-9);
    }
    return true;
  }

  static int RoundsFor(std::size_t candidates) {
    return std::max(1, static_cast<int>(std::bit_width(candidates - 1)));
  }

  // An equal share for each round to come; at least what a candidate needs, as long as a
  // round of that leaves as much again.
  std::size_t WindowsFor(std::size_t candidates) const {
    const double affordable =
        std::max(0.0, Left()) / (window_seconds_ * static_cast<double>(candidates));
    const double share = affordable / RoundsFor(candidates);
    const double least = static_cast<double>(options_.least_windows);
    if (share < least && affordable < 2 * least) return 0;
    return static_cast<std::size_t>(
        std::clamp(share, least, static_cast<double>(options_.most_windows)));
  }

  // Candidate 0 and, from the front, as many of those that wait as can each have the
  // least number of windows.
  bool Admit() {
    std::size_t count = waiting_.size();
    while (count > 0 && WindowsFor(count + 1) == 0) --count;
    const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(count);
    alive_.assign(waiting_.begin(), end);
    waiting_.erase(waiting_.begin(), end);
    for (std::size_t i : alive_) records_[i].first = records_[0].all.size();
    alive_.insert(alive_.begin(), 0);
    return count > 0;
  }

  // The worst ones go while there is no time for another round of all.
  void MakeRoom() {
    while (alive_.size() > 2 && WindowsFor(alive_.size()) == 0) {
      const auto worst = std::min_element(
          alive_.begin() + 1, alive_.end(),
          [&](std::size_t a, std::size_t b) { return Score(a) < Score(b); });
      if (result_.candidates[*worst].rounds == 0) return;
      result_.candidates[*worst].status = CandidateStatus::kHalved;
      alive_.erase(worst);
    }
  }

  bool Round() {
    MakeRoom();
    const std::size_t windows = WindowsFor(alive_.size());
    if (windows == 0) return false;
    double elapsed = 0;
    const std::vector<WindowErrors> measured = measure_(alive_, windows, elapsed);
    result_.seconds += elapsed;
    result_.interrupted |= measured.empty();
    if (measured.empty()) return false;
    LL_CHECK_EQ(measured.size(), alive_.size());
    window_seconds_ = elapsed / static_cast<double>(windows * alive_.size());
    for (std::size_t i = 0; i < alive_.size(); ++i) Add(alive_[i], measured[i]);
    batches_ += measured.front().batch.back() + 1;
    for (std::size_t i : alive_) Compare(i);
    return true;
  }

  void Add(std::size_t candidate, const WindowErrors& errors) {
    Record& record = records_[candidate];
    const std::size_t windows = errors.all.size();
    LL_CHECK(errors.seconds.size() == windows && errors.batch.size() == windows);
    for (std::size_t i = 0; i < windows; ++i) {
      const std::size_t batch = batches_ + errors.batch[i];
      record.all.push_back({{errors.all[i], errors.seconds[i]}, batch});
      record.robust.push_back({{errors.robust[i], errors.seconds[i]}, batch});
    }
  }

  void Compare(std::size_t candidate) {
    CandidateOutcome& out = result_.candidates[candidate];
    out.rounds += 1;
    out.windows = records_[candidate].all.size();
    if (candidate > 0) out.efficiency = Ratio(0, candidate, options_.choose_confidence);
    const Record& own = records_[candidate];
    out.with_all_pixels = Product(Since(records_[0].all, own.first)) / Product(own.all);
    if (std::isnan(out.with_all_pixels)) out.with_all_pixels = 1;  // no error in either
  }

  static std::span<const WindowCost> Since(const std::vector<WindowCost>& windows,
                                           std::size_t first) {
    return std::span(windows).subspan(first);
  }

  // On the windows that both had: candidate 0, or one that came at the same time.
  Interval Ratio(std::size_t baseline, std::size_t other, double confidence) const {
    const Record &a = records_[baseline], &b = records_[other];
    const std::size_t first = std::max(a.first, b.first);
    return stat::EfficiencyRatio(Blocks(Since(a.robust, first - a.first)),
                                 Blocks(Since(b.robust, first - b.first)), confidence);
  }

  double Score(std::size_t candidate) const {
    return result_.candidates[candidate].Score();
  }

  // What is certainly worse than the best, and the lower half; never candidate 0.
  void Drop() {
    std::sort(alive_.begin(), alive_.end(), [&](std::size_t a, std::size_t b) {
      return Score(a) != Score(b) ? Score(a) > Score(b) : a < b;
    });
    const double sure = 1 - stat::SidakLevel(1 - options_.drop_confidence,
                                             std::max(1, int(alive_.size()) - 1));
    const std::size_t best = alive_.front(), half = (alive_.size() + 1) / 2;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      const std::size_t candidate = alive_[i];
      CandidateOutcome& out = result_.candidates[candidate];
      if (candidate == 0 || candidate == best) {
        kept.push_back(candidate);
      } else if (Ratio(best, candidate, sure).high < 1) {
        out.status = CandidateStatus::kWorse;
      } else if (i >= half) {
        out.status = CandidateStatus::kHalved;
      } else {
        kept.push_back(candidate);
      }
    }
    // The default alone is left, or certainly worse than the only other one.
    const bool settled = kept.size() == 2 && best != 0 && Ratio(best, 0, sure).high < 1;
    for (std::size_t candidate : kept) {
      result_.candidates[candidate].status = CandidateStatus::kKept;
    }
    std::sort(kept.begin(), kept.end());
    alive_ =
        settled || (best == 0 && CertainlyBest()) ? std::vector<std::size_t>{0} : kept;
  }

  // No other that is left can be better than the default by more than a little.
  bool CertainlyBest() const {
    constexpr double kLittle = 1.03;
    return std::none_of(result_.candidates.begin() + 1, result_.candidates.end(),
                        [&](const CandidateOutcome& c) {
                          return c.status == CandidateStatus::kKept &&
                                 !(c.efficiency.high < kLittle);
                        });
  }

  bool IsBetter(std::size_t candidate) const {
    const CandidateOutcome& c = result_.candidates[candidate];
    return c.status == CandidateStatus::kKept && c.efficiency.low > 1 &&
           c.Score() > 1 + margins_[candidate];
  }

  void Choose() {
    for (std::size_t i = 1; i < margins_.size(); ++i) {
      if (IsBetter(i) && (result_.chosen == 0 || Score(i) > Score(result_.chosen))) {
        result_.chosen = i;
      }
    }
    result_.candidates[result_.chosen].status = CandidateStatus::kChosen;
    for (std::size_t i = 0; i < margins_.size(); ++i) Explain(i);
  }

  void Explain(std::size_t candidate) {
    CandidateOutcome& c = result_.candidates[candidate];
    const std::string after =
        fmt::format("after {} round{}", c.rounds, c.rounds == 1 ? "" : "s");
    if (c.status == CandidateStatus::kWorse) {
      c.reason = "certainly less efficient than the best " + after;
    } else if (c.status == CandidateStatus::kHalved) {
      c.reason = "in the less efficient half " + after;
    } else if (c.status == CandidateStatus::kChosen && candidate > 0) {
      c.reason = "certainly more efficient than the default, " + after;
    } else if (c.status == CandidateStatus::kChosen) {
      c.reason = "no other is certainly more efficient";
    } else if (c.status == CandidateStatus::kKept && candidate == 0) {
      c.reason = "the default; another is certainly more efficient";
    } else if (c.status == CandidateStatus::kKept) {
      c.reason = IsBetter(candidate)    ? "better than the default, but not the best"
                 : c.efficiency.low > 1 ? "better, but by less than it must gain"
                                        : "not certainly better than the default";
    }
  }

  const std::vector<double>& margins_;
  const MeasureRound& measure_;
  const HalvingOptions& options_;
  std::vector<Record> records_;
  std::vector<std::size_t> waiting_, alive_;
  double window_seconds_ = 0;
  std::size_t batches_ = 0;  // of all rounds
  HalvingResult result_;
};

}  // namespace

const char* Name(CandidateStatus status) {
  switch (status) {
    case CandidateStatus::kChosen:
      return "chosen";
    case CandidateStatus::kKept:
      return "kept";
    case CandidateStatus::kWorse:
      return "worse";
    case CandidateStatus::kHalved:
      return "halved";
    case CandidateStatus::kSkipped:
      return "skipped";
    case CandidateStatus::kRefused:
      return "refused";
  }
  return "";
}

double CandidateOutcome::Score() const {
  return std::min(efficiency.value, with_all_pixels);
}

HalvingResult Halve(const std::vector<double>& margins, const MeasureRound& measure,
                    const HalvingOptions& options) {
  return Halving(margins, measure, options).Run();
}

}  // namespace lanelight
