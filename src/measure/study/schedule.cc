#include "src/measure/study/scene_runner.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "src/base/stat/interval.h"
#include "src/render/estimate/estimate.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kMaxSpp = 1u << 20;
constexpr double kMinSeconds = 1e-9;  // replaces 0 of a coarse clock

std::vector<std::uint64_t> Sorted(std::vector<std::uint64_t> counts) {
  std::ranges::sort(counts);
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

double StandardDeviation(const std::vector<double>& values) {
  double mean = 0, squares = 0;
  for (double v : values) mean += v / double(values.size());
  for (double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / double(values.size() - 1));
}

class TimedRenders {
 public:
  TimedRenders(const Job& job, const std::vector<Strategy>& strategies, double seconds,
               const std::atomic<bool>* stop)
      : job_(job), strategies_(strategies), seconds_(seconds), stop_(stop) {}

  std::vector<Calibration> Run() {
    for (std::size_t i = 0; i < strategies_.size() && !IsStopped(); ++i) {
      renders_.push_back({WarmUp(strategies_[i]), {}, {}});
    }
    for (int round = 0; round < kTimedRounds; ++round) {
      for (std::size_t i = 0; i < renders_.size() && !IsStopped(); ++i) Measure(i);
    }
    if (IsStopped()) return {};
    std::vector<Calibration> out;
    for (const TimedStrategy& timed : renders_) out.push_back(Evaluate(timed));
    return out;
  }

 private:
  struct TimedStrategy {
    std::uint64_t spp = 1;
    // Processor seconds; `few`: with a quarter of the samples.
    std::vector<double> seconds, few;
    double for_small_error = std::numeric_limits<double>::infinity();
    std::uint64_t FewSpp() const { return std::max<std::uint64_t>(spp / 4, 1); }
  };
  struct Seconds {
    double wall = 0, cpu = 0;
  };

  bool IsStopped() const { return stop_ != nullptr && *stop_; }

  JobRun Render(const Strategy& strategy, std::uint64_t spp) {
    return RunJob(WithRender(job_, strategy, spp, job_.seed), {}, stop_);
  }

  static Seconds SecondsOf(const RunResult& result) {
    return {std::max(result.seconds, kMinSeconds),
            std::max(result.cpu_seconds, kMinSeconds)};
  }

  // Assumes that squared errors fall as 1 / samples.
  static double ForSmallError(const FilmAccumulator& film, std::uint64_t spp) {
    const ErrorEstimate error = EstimateError(film);
    if (!error.available) return std::numeric_limits<double>::infinity();
    return double(spp) * error.relmse.value / (kSmallError * kSmallError);
  }

  // Doubles the samples until a render takes as long as a timed one, and returns them.
  std::uint64_t WarmUp(const Strategy& strategy) {
    const double wanted = std::clamp(seconds_ / 2, kMinTimedSeconds, kMaxTimedSeconds);
    std::uint64_t spp = 1;
    Render(strategy, spp);
    // Stops at half the time, since the next render takes twice as long.
    while (SecondsOf(Render(strategy, spp).result).wall < wanted / 2 && spp < kMaxSpp &&
           !IsStopped()) {
      spp *= 2;
    }
    return spp;
  }

  void Measure(std::size_t i) {
    TimedStrategy& timed = renders_[i];
    timed.few.push_back(SecondsOf(Render(strategies_[i], timed.FewSpp()).result).cpu);
    const JobRun run = Render(strategies_[i], timed.spp);
    const Seconds elapsed = SecondsOf(run.result);
    timed.for_small_error = ForSmallError(run.film, timed.spp);
    timed.seconds.push_back(elapsed.cpu);
    wall_per_cpu_.push_back(elapsed.wall / elapsed.cpu);
  }

  Calibration Evaluate(const TimedStrategy& timed) const {
    std::vector<double> logarithms;
    for (double s : timed.seconds) logarithms.push_back(std::log(s));
    // The standard error of a median of normal values.
    const double deviation = StandardDeviation(logarithms) *
                             std::sqrt(std::numbers::pi / 2 / double(logarithms.size()));
    const double samples =
        SamplesOfBudget(seconds_ / stat::Median(wall_per_cpu_),
                        {double(timed.spp), stat::Median(timed.seconds)},
                        {double(timed.FewSpp()), stat::Median(timed.few)});
    return {std::clamp(samples, 1.0, double(kMaxSpp)), deviation, timed.for_small_error};
  }

  const Job& job_;
  const std::vector<Strategy>& strategies_;
  double seconds_;
  const std::atomic<bool>* stop_;
  std::vector<TimedStrategy> renders_;
  std::vector<double> wall_per_cpu_;
};

}  // namespace

double SamplesOfBudget(double budget, const TimedRender& timed, const TimedRender& few) {
  const double mean = timed.seconds / timed.samples;
  const double more = timed.samples - few.samples;
  const double slope = more > 0 ? (timed.seconds - few.seconds) / more : mean;
  const double of_sample = std::clamp(slope, mean / 4, mean);
  return (budget - (timed.seconds - of_sample * timed.samples)) / of_sample;
}

std::vector<Calibration> Calibrate(const Job& job,
                                   const std::vector<Strategy>& strategies,
                                   double seconds, const std::atomic<bool>* stop) {
  return TimedRenders(job, strategies, seconds, stop).Run();
}

std::uint64_t DefaultLargest(const Calibration& baseline) {
  const double enough = std::clamp(baseline.for_small_error, 1.0, double(kMinLargest));
  return std::max(std::bit_floor(std::uint64_t(baseline.samples)),
                  std::bit_ceil(std::uint64_t(std::ceil(enough))));
}

std::vector<std::uint64_t> CountsUpTo(std::uint64_t largest) {
  std::vector<std::uint64_t> counts;
  for (std::uint64_t n = 1; n < largest; n *= 2) counts.push_back(n);
  const int shift = std::max(0, int(std::bit_width(largest)) - 7);
  counts.push_back(largest >> shift << shift);
  return Sorted(counts);
}

void ChooseCounts(const StudyOptions& options, const Job& job,
                  std::vector<StrategyRuns>& strategies, const std::atomic<bool>* stop) {
  std::vector<StrategyRuns*> runs;
  std::vector<Strategy> calibrated;
  const bool each = options.spp.empty() && options.budget;
  for (StrategyRuns& s : strategies) {
    if (s.status != RunStatus::kOk) continue;
    if (each || calibrated.empty()) calibrated.push_back(s.named.strategy);
    runs.push_back(&s);
    s.counts = Sorted(options.spp);
  }
  if (!options.spp.empty() || runs.empty()) return;
  const std::vector<Calibration> found =
      Calibrate(job, calibrated, options.budget.value_or(kDefaultStudySeconds), stop);
  for (std::size_t i = 0; i < runs.size() && !found.empty(); ++i) {
    const Calibration& c = found[each ? i : 0];
    runs[i]->counts = CountsUpTo(each ? std::uint64_t(c.samples) : DefaultLargest(c));
    runs[i]->count_deviation = each ? c.deviation : 0;
  }
}

}  // namespace lanelight
