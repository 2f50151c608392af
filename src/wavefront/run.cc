#include "src/wavefront/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <utility>

#include "src/core/check.h"
#include "src/core/clock.h"
#include "src/core/parallel.h"
#include "src/prepare/groups.h"
#include "src/prepare/tables.h"
#include "src/scene/rendered_pixels.h"
#include "src/wavefront/crew_start.h"
#include "src/wavefront/patience.h"
#include "src/wavefront/plan_features.h"
#include "src/wavefront/profile.h"
#include "src/wavefront/sample_rate.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/stop_watcher.h"
#include "src/wavefront/tasks.h"
#include "src/wavefront/training.h"

namespace lanelight {

namespace {

using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The seed of kernels: another one after each kSamplesPerSeed samples.
std::uint32_t SeedOf(std::uint64_t seed, std::uint64_t first_sample) {
  const std::uint64_t turn = first_sample / kSamplesPerSeed * 0x9e3779b97f4a7c15u;
  return static_cast<std::uint32_t>(seed ^ (seed >> 32) ^ (turn >> 32));
}

class Runner : public TaskWatcher {
 public:
  Runner(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
         FilmAccumulator& film)
      : scene_(scene),
        plan_(plan),
        options_(options),
        film_(film),
        crew_(options.crew != nullptr ? *options.crew : alone_),
        tables_(MakeStrategyTables(scene)),
        tasks_(scene, plan_, run_, options, PlannedSpp()) {
    LL_CHECK(film.groups() == GroupsOf(scene.strategy));
    LL_CHECK(options.windows.empty() || crew_.ranks() == 1);
    run_ = Parameters();
    films_.emplace(run_.planes, scene.strategy.coefficient.value_or(1), film_);
    if (!Allocates()) return;
    LL_CHECK_EQ(tasks_.pixels(), RenderedPixels(scene.film).pixels());  // no part
    films_->UseWeights();
  }

  /// Samples of every pixel up to `end`, in tasks of `per_task`.
  struct Part {
    std::uint64_t first = 0, begin = 0, end = 0;
    std::uint32_t per_task = 1;
    Clock::time_point start;
  };

  /// Starts the clock, and trains the strategy or goes on where a run was put down.
  void Start() {
    start_ = Clock::now();
    start_cpu_ = ProcessCpuSeconds();
    const bool restored = options_.keeper != nullptr && Restore();
    if (!restored && NeedsTraining(plan_)) planned_samples_ = PlannedSamples();
    // Ranks are told once which tiles there are.
    if (crew_.ranks() > 1 && Allocates()) tasks_.CutIntoCells();
    if (crew_.ranks() > 1) crew_.Share(ToBytes(StartOfOthers(restored)));
    if (!restored && NeedsTraining(plan_)) TrainStrategy();
    AgreeOnTraining();
    if (options_.seconds > 0) pace_.emplace(options_.seconds, PaceTasks());
    patience_.emplace(options_.seconds, Elapsed());
    if (!restored) return;
    AllocateIfDue();
    LookIfDue(LastLevel());
  }

  /// The same for a rank that serves.
  void Join(const CrewStart& start) {
    start_ = Clock::now();
    planned_samples_ = start.planned_samples;
    if (!start.restored && NeedsTraining(plan_)) TrainStrategy();
    if (start.trained) {
      training_.changes = start.changes;
      PutTraining(start.tables, tables_);
      UseTraining();
    }
    AgreeOnTraining();
    patience_.emplace();
  }

  /// Tasks from here on begin with this sample, or later ones.
  void BeginWith(std::uint64_t first) { run_.seed = SeedOf(options_.seed, first); }

  /// What to render next; nothing once the render is done.
  std::optional<Part> Next() {
    const std::uint64_t done = tasks_.Done();
    if (done >= Limit() || Ended() || reached_) return std::nullopt;
    const Round round = NextRound();
    Part part;
    part.begin = done;
    part.first = done / kSamplesPerSeed * kSamplesPerSeed;
    part.end = std::min({Limit(), NextLook(done), NextDecision(done),
                         done + round.samples(), part.first + kSamplesPerSeed});
    part.per_task = round.per_task;
    part.start = Clock::now();
    BeginWith(part.first);
    return part;
  }

  void Render(const Part& part) {
    crew_.RunRound({part.first, part.end, part.per_task}, tasks_, *this, *films_);
  }

  Tasks& tasks() { return tasks_; }
  Films& films() { return *films_; }

  /// Takes note of a part that has been rendered, perhaps not to its end.
  void Finish(const Part& part) {
    if (options_.keeper != nullptr && options_.keeper->Due() && !Ended()) Keep();
    if (tasks_.Done() < part.end) return;
    if (pace_) pace_->Took(part.end - part.begin, Since(part.start));
    if (pace_ && fit_seconds_ == 0 && 2 * Elapsed() > options_.seconds) TimeFit();
    AllocateIfDue();
    LookIfDue(part.end);
  }

  /// The last state is kept too, also where another rank has failed.
  void End() {
    if (options_.keeper != nullptr) Keep(Reason() != StopReason::kInterrupted);
    crew_.Dismiss();
  }

  RunResult Result();

 private:
  bool Restore() {
    RunState state = {*films_, {}, false, {}, {}, false};
    if (!options_.keeper->Restore(state)) return false;
    before_ = state.counts;
    tasks_.GoOn(*films_, state.counts);
    if (!state.trained) return !NeedsTraining(plan_);
    training_ = std::move(state.training);
    PutTraining(state.tables, tables_);
    UseTraining();
    return true;
  }

  void Keep(bool finished = false) {
    RunState state = {*films_, Counts(), training_done_, training_, {}, finished};
    if (training_done_) state.tables = TakeTraining(tables_);
    options_.keeper->Keep(state);
  }

  RunCounts Counts() const {
    RunCounts counts = tasks_.counts();
    counts.seconds = Elapsed();
    // What came before, and of other ranks, is in it already.
    counts.cpu_seconds += ProcessCpuSeconds() - start_cpu_;
    return counts;
  }

  CrewStart StartOfOthers(bool restored) const {
    CrewStart start = {tasks_.rects(), planned_samples_,  restored,
                       training_done_, training_.changes, {}};
    if (training_done_) start.tables = TakeTraining(tables_);
    return start;
  }

  // Another processor or library might learn other numbers.
  void AgreeOnTraining() {
    if (crew_.ranks() == 1) return;
    const std::string own =
        training_done_ ? Fingerprint(training_, TakeTraining(tables_)) : "nothing";
    crew_.Agree("has learned something else before the image", own,
                [&](const std::string& leaders, const std::string& its) {
                  if (leaders == its || Interrupted()) return std::string();
                  return fmt::format("\n  rank 0: {}\n  it:     {}", leaders, its);
                });
  }

  // That pilot passes are sized for. All ranks have the leader's: clocks differ.
  std::uint64_t PlannedSamples() const {
    if (options_.planned_samples > 0) return options_.planned_samples;
    const std::uint64_t pixels = RenderedPixels(scene_.film).pixels();
    const bool decides = plan_.features.Has(Feature::kDecides);
    if (decides && options_.seconds > 0) {
      const StopWatcher watcher(options_.stop);
      return SamplesWithin(options_.seconds, scene_, plan_.options, run_, &watcher);
    }
    return decides ? DecidedBy(pixels) : std::max(pixels * kPilotSpp, kLeastPilot);
  }

  void TrainStrategy() {
    TrainingOptions options;
    options.planned_samples = planned_samples_;
    options.keep_roulette = options_.keep_roulette;
    // Ranks train for themselves and have to agree: their clocks would not.
    if (options_.spp == 0 && !options_.samples_needed && crew_.ranks() == 1) {
      options.seconds = options_.seconds;
    }
    options.stop = options_.stop;
    training_ = Train({scene_, plan_, run_, options, tables_});
    training_.seconds = Since(start_);
    training_.cpu_seconds = ProcessCpuSeconds() - start_cpu_;
    // What was cut short is trained anew when the run goes on.
    if (!Interrupted()) UseTraining();
  }

  // The image may be rendered with another roulette then.
  void UseTraining() {
    training_done_ = true;
    PlanOptions changed = plan_.options;
    changed.Change(training_.changes);
    if (PlannedStrategy(scene_, changed) == scene_.strategy) return;
    plan_ = MakePlan(scene_, changed);
    run_ = Parameters();
  }

  RunParameters Parameters() const {
    RunParameters run = MakeRunParameters(scene_, plan_);
    run.seed = SeedOf(options_.seed, 0);
    run.spp = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(options_.spp, kSamplesPerSeed));
    run.tables = &tables_;
    return run;
  }

  /// Samples per pixel at most.
  std::uint64_t Limit() const {
    return options_.spp > 0 ? options_.spp : kMostSamplesPerPixel;
  }
  bool OpenEnded() const { return options_.seconds > 0 || options_.samples_needed; }

  // Without a sample count the partition assumes many samples.
  std::uint64_t PlannedSpp() const {
    return OpenEnded() || options_.spp == 0 ? kPilotSpp : options_.spp;
  }

  // Windows are cut from an image whose other pixels nobody knows.
  bool Allocates() const {
    return scene_.strategy.allocation == Allocation::kError && options_.windows.empty();
  }

  // Where pixels begin to differ in their samples.
  std::uint64_t NextDecision(std::uint64_t done) const {
    return Allocates() && done < kAllocationPilot ? kAllocationPilot
                                                  : kMostSamplesPerPixel;
  }

  // What the pilot says is in the films, for a run that goes on later.
  void AllocateIfDue() {
    if (!Allocates() || allocated_ || tasks_.Done() < kAllocationPilot) return;
    allocated_ = true;
    if (tasks_.IsAt(kAllocationPilot)) {
      const PixelRect window = RenderedPixels(scene_.film);
      films_->weights() = WeighPixels(film_, CellSide(window, scene_.strategy.control));
    }
    tasks_.UseShares(*films_);
    if (pace_) pace_->Cut(PaceTasks());
  }

  std::uint64_t NextLook(std::uint64_t done) const {
    if (!options_.samples_needed) return kMostSamplesPerPixel;
    return LookFrom(done + 1, film_.groups().unit);
  }

  // Samples per pixel of a run that goes on. Where pixels have shares of them, it may
  // have been at its last look already, and no pixel has had more since.
  std::uint64_t LastLevel() const {
    const std::uint64_t done = tasks_.Done();
    std::uint64_t look = done;
    for (auto next = NextLook(0); next <= done; next = NextLook(next)) look = next;
    return tasks_.IsAt(look) ? look : done;
  }

  // Asks how many samples are needed. A run that was put down within a round has taken
  // its look before; what it says of an uneven film is not what one run would hear.
  void LookIfDue(std::uint64_t done) {
    if (!options_.samples_needed || done == 0 || !tasks_.IsAt(done)) return;
    if (done != LookFrom(done, film_.groups().unit) && done != Limit()) return;
    film_.FitControl();
    needed_ = options_.samples_needed(done);
    reached_ = needed_ <= double(done);
  }

  void TimeFit() {
    const Clock::time_point begin = Clock::now();
    film_.FitControl();
    fit_seconds_ = Since(begin);
  }

  double Elapsed() const { return before_.seconds + Since(start_); }
  bool Interrupted() const override {
    return (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed)) ||
           crew_.Stopped();
  }
  bool OutOfTime() const {
    // The first round always ends: an image with unsampled pixels is no image.
    return options_.seconds > 0 && every_pixel_ &&
           Elapsed() >= options_.seconds - fit_seconds_;
  }
  bool Ended() {
    every_pixel_ = tasks_.Done() > 0;
    return Interrupted() || OutOfTime() || put_down_;
  }
  bool Stopped() const override {
    return Interrupted() || OutOfTime() || put_down_ ||
           (options_.keeper != nullptr && options_.keeper->Due());
  }

  bool PutsDown() const override {
    // Without a budget only a stop matters, and clocks need not be read.
    const bool stopped = Interrupted();
    if (!stopped && options_.seconds <= 0) return false;
    if (patience_->IsOver(stopped, every_pixel_, Elapsed())) put_down_ = true;
    return put_down_;
  }

  Pace::Tasks PaceTasks() const {
    Pace::Tasks tasks;
    tasks.tiles = tasks_.tiles();
    tasks.threads = crew_.threads();
    tasks.most = tasks_.FullRound();
    tasks.unit = film_.groups().unit;
    return tasks;
  }

  Round NextRound() const {
    if (pace_) return pace_->Next(Elapsed());
    return crew_.Widen(tasks_.FullRound());
  }

  void TaskDone() override {
    if (options_.seconds > 0) patience_->Ended(Elapsed());
    if (!options_.on_progress) return;
    std::unique_lock lock(progress_mutex_, std::try_to_lock);
    if (!lock || Since(last_report_) < 0.1) return;
    last_report_ = Clock::now();
    Progress progress;
    progress.seconds = Elapsed();
    progress.samples = tasks_.taken();
    const double pixels = double(tasks_.pixels()), samples = double(progress.samples);
    const double by_samples =
        options_.spp > 0 ? samples / (pixels * double(options_.spp)) : 0;
    const double by_time = options_.seconds > 0 ? progress.seconds / options_.seconds : 0;
    // Errors fall like 1 / samples, so samples are in proportion to the time it takes.
    const double by_need = samples / (pixels * needed_);
    progress.fraction = std::min(1.0, std::max({by_samples, by_time, by_need}));
    options_.on_progress(progress);
  }

  StopReason Reason() const {
    if (reached_) return StopReason::kTarget;
    // Only what has left samples out counts: a signal may come after the last one.
    if (tasks_.Done() >= Limit()) return StopReason::kSamples;
    return Interrupted() ? StopReason::kInterrupted : StopReason::kTime;
  }

  const CompiledScene& scene_;
  Plan plan_;
  const RunOptions& options_;
  FilmAccumulator& film_;
  OneProcess alone_;
  Crew& crew_;
  StrategyTables tables_;
  RunParameters run_;
  Tasks tasks_;
  std::optional<Films> films_;
  TrainingOutcome training_;
  bool training_done_ = false;
  std::uint64_t planned_samples_ = 0;  // that it is sized for
  std::optional<Pace> pace_;           // with a time budget
  mutable std::optional<Patience> patience_;
  mutable std::atomic<bool> put_down_{false};  // tasks were; that ends the run
  bool every_pixel_ = false;                   // has a sample
  bool allocated_ = false;                     // samples, by their weights
  double needed_ = INFINITY;                   // samples per pixel, by the last look
  bool reached_ = false;                       // no more are needed
  double fit_seconds_ = 0;                     // that the last step takes
  RunCounts before_;                           // this run went on with
  Clock::time_point start_, last_report_;
  TickScale ticks_;
  double start_cpu_ = 0;
  std::mutex progress_mutex_;
};

RunResult Runner::Result() {
  RunResult result;
  result.ranks = crew_.ranks();
  result.bytes_between_ranks = crew_.bytes();
  film_.FitControl();
  const RunCounts counts = Counts();
  result.seconds = counts.seconds;
  result.cpu_seconds = counts.cpu_seconds;
  result.stop_reason = Reason();
  result.stopped_early = result.stop_reason == StopReason::kInterrupted;
  if (options_.samples_needed) {
    result.looks = LooksUpTo(tasks_.Done(), film_.groups().unit);
  }
  result.pilot_seconds = training_.seconds;
  result.pilot_cpu_seconds = training_.cpu_seconds;
  result.pilot_samples = training_.samples;
  result.pilot_rays = training_.rays;
  result.pilot_note = training_.note;
  result.pilot_changes = training_.changes;
  result.roulette = PlannedStrategy(scene_, plan_.options).roulette;
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
    runner.Render(*part);
    runner.Finish(*part);
  }
  runner.End();
  return runner.Result();
}

void ServeRun(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.crew != nullptr);
  const CrewStart start = CrewStartFromBytes(options.crew->Share(""));
  RunOptions own = options;
  own.tiles = start.tiles;
  own.stop = nullptr;  // who leads says when training and tasks end
  Runner runner(scene, plan, own, film);
  runner.Join(start);
  options.crew->Serve({runner.tasks(), runner.films(),
                       [&](std::uint64_t first) { runner.BeginWith(first); },
                       options.stop});
}

}  // namespace lanelight
