#include "src/wavefront/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <utility>

#include "src/core/check.h"
#include "src/core/clock.h"
#include "src/core/parallel.h"
#include "src/prepare/tables.h"
#include "src/wavefront/profile.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/tasks.h"
#include "src/wavefront/training.h"

namespace lanelight {

namespace {

using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Runner : public TaskWatcher {
 public:
  Runner(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
         FilmAccumulator& film)
      : scene_(scene),
        plan_(plan),
        options_(options),
        film_(film),
        tables_(MakeStrategyTables(scene)),
        tasks_(scene, plan_, run_, options, PlannedSpp()) {
    if (OpenEnded()) film_.Regroup(FirstGroupSize(scene.strategy));
    run_ = Parameters();
    films_.emplace(run_.planes, scene.strategy.coefficient.value_or(1), film_);
  }

  /// Samples [begin, end) of every pixel, in tasks of `per_task`.
  struct Part {
    std::uint64_t begin = 0, end = 0;
    std::uint32_t per_task = 1;
    Clock::time_point start;
  };

  /// Trains the strategy and starts the clock.
  void Start() {
    start_ = Clock::now();
    start_cpu_ = ProcessCpuSeconds();
    if (NeedsTraining(plan_)) TrainStrategy();
    if (options_.seconds > 0) pace_.emplace(options_.seconds, PaceTasks());
    // The first look chooses the groups, the later ones ask whether to go on.
    next_look_ = OpenEnded() ? FirstSamples() : Limit();
  }

  /// What to render next; nothing once the render is done.
  std::optional<Part> Next() const {
    if (done_ >= Limit() || Stopped() || reached_) return std::nullopt;
    const Round round = NextRound();
    const std::uint64_t end = std::min({Limit(), next_look_, done_ + round.samples()});
    return Part{done_, end, round.per_task, Clock::now()};
  }

  Tasks& tasks() { return tasks_; }
  Films& films() { return *films_; }

  /// Takes note of a part that has been rendered.
  void Finish(const Part& part) {
    done_ = part.end;
    if (Stopped()) return;  // perhaps within the part
    if (pace_) pace_->Took(part.end - part.begin, Since(part.start));
    if (pace_ && fit_seconds_ == 0 && 2 * Since(start_) > options_.seconds) TimeFit();
    if (done_ == next_look_ || (done_ == Limit() && options_.samples_needed)) {
      next_look_ = Look(next_look_);
    }
  }

  RunResult Result();

 private:
  // The image may then be rendered with a simpler roulette.
  void TrainStrategy() {
    TrainingOptions options;
    options.planned_samples =
        options_.planned_samples > 0
            ? options_.planned_samples
            : tasks_.pixels() * (OpenEnded() ? kOpenEndedSpp : options_.spp);
    options.keep_roulette = options_.keep_roulette;
    options.stop = options_.stop;
    training_ = Train({scene_, plan_, run_, options, tables_});
    if (training_.roulette && *training_.roulette != scene_.strategy.roulette) {
      PlanOptions simpler = plan_.options;
      simpler.roulette = training_.roulette;
      plan_ = MakePlan(scene_, simpler);
      run_ = Parameters();
    }
    pilot_seconds_ = Since(start_);
    pilot_cpu_seconds_ = ProcessCpuSeconds() - start_cpu_;
  }

  // Without a sample count the partition assumes many samples.
  static constexpr std::uint64_t kOpenEndedSpp = 32;
  RunParameters Parameters() const {
    RunParameters run = MakeRunParameters(scene_, plan_, film_.group_size());
    run.seed = static_cast<std::uint32_t>(options_.seed ^ (options_.seed >> 32));
    run.spp = static_cast<std::uint32_t>(options_.spp);
    run.tables = &tables_;
    return run;
  }

  /// Samples per pixel at most.
  std::uint64_t Limit() const {
    return options_.spp > 0 ? options_.spp : kMostSamplesPerPixel;
  }
  bool OpenEnded() const { return options_.seconds > 0 || options_.samples_needed; }

  std::uint64_t PlannedSpp() const {
    return OpenEnded() || options_.spp == 0 ? kOpenEndedSpp : options_.spp;
  }

  // Two groups show how much samples differ; a time budget only asks what they cost.
  std::uint64_t FirstSamples() const {
    const std::uint64_t group = FirstGroupSize(scene_.strategy);
    return std::min<std::uint64_t>(kMostSamplesPerPixel,
                                   options_.samples_needed ? 2 * group : group);
  }

  // Asks how many samples are needed, and returns when to ask again.
  std::uint64_t Look(std::uint64_t look) {
    double predicted = pace_ ? double(done_) + pace_->Reach(Since(start_)) : INFINITY;
    double needed = INFINITY;
    if (options_.samples_needed) {
      film_.FitControl();
      needed = options_.samples_needed(done_);
      ++looks_;
    }
    if (done_ < look || done_ > FirstSamples()) {
      reached_ = needed <= double(done_);
      needed_ = needed;
      return NextLook(done_, needed, film_.group_size());
    }
    // Stratification may need fewer samples than these first ones promise.
    constexpr double kGain = 4;
    predicted = std::min(predicted, needed / kGain);
    if (options_.spp > 0) predicted = std::min(predicted, double(options_.spp));
    Regroup(ChooseGroupSize(scene_.strategy, predicted, done_));
    return options_.samples_needed ? FirstLook(film_.group_size()) : kMostSamplesPerPixel;
  }

  void Regroup(std::uint32_t group_size) {
    if (group_size == film_.group_size()) return;
    films_->Regroup(group_size);
    run_ = Parameters();
    // Groups are numbered anew: with the same seed the randomisation of a first small
    // group would come again, and that of two groups must never be the same.
    run_.seed ^= 0x9e3779b9u;
  }

  void TimeFit() {
    const Clock::time_point begin = Clock::now();
    film_.FitControl();
    fit_seconds_ = Since(begin);
  }

  bool Interrupted() const {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }
  bool OutOfTime() const {
    // The first round always ends: an image with unsampled pixels is no image.
    return options_.seconds > 0 && done_ > 0 &&
           Since(start_) >= options_.seconds - fit_seconds_;
  }
  bool Stopped() const override { return Interrupted() || OutOfTime(); }

  Pace::Tasks PaceTasks() const {
    Pace::Tasks tasks;
    tasks.tiles = tasks_.tiles();
    tasks.threads = MaxThreads();
    tasks.most = tasks_.FullRound();
    tasks.unit = scene_.strategy.pairs == Pairs::kAntithetic ? 2 : 1;
    return tasks;
  }

  Round NextRound() const {
    if (pace_) return pace_->Next(Since(start_));
    return tasks_.FullRound();
  }

  void TaskDone() override {
    if (!options_.on_progress) return;
    std::unique_lock lock(progress_mutex_, std::try_to_lock);
    if (!lock || Since(last_report_) < 0.1) return;
    last_report_ = Clock::now();
    Progress progress;
    progress.seconds = Since(start_);
    progress.samples = tasks_.samples();
    const double by_samples =
        options_.spp > 0
            ? double(tasks_.samples()) / (double(tasks_.pixels()) * options_.spp)
            : 0;
    const double by_time = options_.seconds > 0 ? progress.seconds / options_.seconds : 0;
    // Errors fall like 1 / samples, so samples are in proportion to the time it takes.
    const double by_need = double(tasks_.samples()) / (double(tasks_.pixels()) * needed_);
    progress.fraction = std::min(1.0, std::max({by_samples, by_time, by_need}));
    options_.on_progress(progress);
  }

  StopReason Reason() const {
    if (reached_) return StopReason::kTarget;
    // Only what has left samples out counts: a signal may come after the last one.
    if (tasks_.samples() == tasks_.pixels() * Limit()) return StopReason::kSamples;
    return Interrupted() ? StopReason::kInterrupted : StopReason::kTime;
  }

  const CompiledScene& scene_;
  Plan plan_;
  const RunOptions& options_;
  FilmAccumulator& film_;
  StrategyTables tables_;
  RunParameters run_;
  Tasks tasks_;
  std::optional<Films> films_;
  TrainingOutcome training_;
  double pilot_seconds_ = 0, pilot_cpu_seconds_ = 0;
  std::optional<Pace> pace_;  // with a time budget
  std::uint64_t done_ = 0;    // samples per pixel, of parts
  std::uint64_t next_look_ = 0;
  double needed_ = INFINITY;  // samples per pixel, by the last look
  bool reached_ = false;      // no more are needed
  int looks_ = 0;
  double fit_seconds_ = 0;  // that the last step takes
  Clock::time_point start_, last_report_;
  TickScale ticks_;
  double start_cpu_ = 0;
  std::mutex progress_mutex_;
};

RunResult Runner::Result() {
  RunResult result;
  film_.FitControl();
  result.seconds = Since(start_);
  result.cpu_seconds = ProcessCpuSeconds() - start_cpu_;
  result.samples = tasks_.samples();
  result.stop_reason = Reason();
  result.stopped_early = result.stop_reason == StopReason::kInterrupted;
  result.group_size = film_.group_size();
  result.looks = looks_;
  result.pilot_seconds = pilot_seconds_;
  result.pilot_cpu_seconds = pilot_cpu_seconds_;
  result.pilot_samples = training_.samples;
  result.pilot_rays = training_.rays;
  result.pilot_note = training_.note;
  result.roulette = plan_.options.roulette.value_or(scene_.strategy.roulette);
  result.control = films_->Control();
  result.stages = EmptyProfiles(plan_);
  result.parts = EmptyParts();
  result.bytes_in_flight = plan_.wavefront * plan_.bytes_per_path;
  result.trace.start = ticks_.start();
  result.trace.seconds_per_tick = ticks_.SecondsPerTick();
  tasks_.AddCounts(result);
  return result;
}

}  // namespace

const char* Name(StopReason reason) {
  static constexpr const char* kNames[] = {"samples", "time", "target", "interrupted"};
  return kNames[static_cast<int>(reason)];
}

RunResult Run(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.spp > 0 || options.seconds > 0 || options.samples_needed ||
           options.stop != nullptr);
  Runner runner(scene, plan, options, film);
  runner.Start();
  while (const auto part = runner.Next()) {
    runner.tasks().RunRound(part->begin, part->end, part->per_task, runner,
                            runner.films());
    runner.Finish(*part);
  }
  return runner.Result();
}

}  // namespace lanelight
