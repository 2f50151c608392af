#include "src/render/run/run.h"

#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/clock.h"
#include "src/base/core/parallel.h"
#include "src/render/run/convergence_checks.h"
#include "src/render/run/film_show.h"
#include "src/render/run/run_parts.h"
#include "src/render/run/run_setting.h"
#include "src/render/run/run_start.h"
#include "src/render/run/run_strategy.h"
#include "src/render/run/run_watch.h"
#include "src/render/wave/profile.h"
#include "src/scene/prepare/groups.h"

namespace lanelight {

namespace {

// Without a sample count the partition assumes many samples.
std::uint64_t PlannedSpp(const RunOptions& options) {
  const bool open_ended = options.seconds > 0 || options.samples_needed;
  return open_ended || options.spp == 0 ? kPilotSpp : options.spp;
}

// A run and its parts. Each refers to those above it.
struct Runner {
  Runner(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
         FilmAccumulator& film)
      : group(options.group != nullptr ? *options.group : alone),
        strategy(scene, plan, options, clock),
        tasks(scene, strategy.plan(), strategy.run(), options, PlannedSpp(options)),
        films(strategy.run().planes, scene.strategy.coefficient.value_or(1), film),
        work(group, clock, tasks, films),
        setting{options, clock, tasks, films, work},
        checks(setting),
        show(setting),
        watch(setting, checks, show),
        parts(setting, checks, watch) {
    LL_CHECK_EQ(film.groups().replicates, GroupsOf(scene.strategy).replicates);
    LL_CHECK_EQ(film.groups().unit, GroupsOf(scene.strategy).unit);
    films.UseResponse(scene.view.film.response);
    LL_CHECK(options.windows.empty() || group.ranks() == 1);
  }

  void Start();
  void Keep(bool finished);
  RunResult Result();
  /// All of a run, for a worker.
  void Serve(const RunStart& start, const std::atomic<bool>* stop);

  bool Restore();
  RunCounts Counts() const;

  RunClock clock;
  RankGroup alone;
  RankGroup& group;
  RunStrategy strategy;
  Tasks tasks;
  Films films;
  GroupTasks work;
  const RunSetting setting;
  ConvergenceChecks checks;
  FilmShow show;
  RunWatch watch;
  RunParts parts;
  TickScale ticks;  // the last to be made: a trace begins when the run does
};

// Starts the clock, and trains the strategy or goes on where a run was put down.
void Runner::Start() {
  clock.Start();
  const bool restored = setting.options.keeper != nullptr && Restore();
  RunStart start;
  start.have_samples = tasks.counts().samples > 0;
  start.planned_training = restored ? 0 : strategy.PlannedTraining();
  if (group.ranks() > 1) {
    start.tiles = tasks.tiles();
    group.Share(ToBytes(start));
  }
  if (start.planned_training > 0) strategy.Train(start.planned_training, group);
  films.film().set_dependents(strategy.Dependents());
  if (group.ranks() > 1) {
    group.Share(ToBytes(
        RunTraining{strategy.trained(), strategy.training().changes, strategy.Tables()}));
  }
  work.Deal(start.have_samples);
  parts.Start();
  show.Start();
  watch.Start();
  if (restored) checks.CheckAgain();
}

bool Runner::Restore() {
  RunState state = {{}, films};
  if (!setting.options.keeper->Restore(state)) return false;
  clock.GoOn(state.counts.seconds);
  tasks.GoOn(films, state.counts);
  if (!state.trained) return !NeedsTraining(strategy.plan());
  strategy.Restore(std::move(state.training), state.tables);
  return true;
}

void Runner::Keep(bool finished) {
  work.Gather();
  RunState state = {
      {Counts(), strategy.trained(), strategy.training(), strategy.Tables()},
      films,
      finished};
  setting.options.keeper->Keep(state);
}

RunCounts Runner::Counts() const {
  RunCounts counts = tasks.counts();
  counts.seconds = clock.Elapsed();
  // What came before, and of other ranks, is in it already.
  counts.cpu_seconds += clock.CpuSeconds();
  return counts;
}

void Runner::Serve(const RunStart& start, const std::atomic<bool>* stop) {
  clock.Start();
  if (start.planned_training > 0) strategy.Train(start.planned_training, group);
  // What the leader has learned, to the last bit, also where another processor's
  // elementary functions are rounded otherwise.
  const RunTraining learned = RunTrainingFromBytes(group.Share(""));
  if (learned.trained) {
    TrainingOutcome training;
    training.changes = learned.changes;
    strategy.Restore(std::move(training), learned.tables);
  }
  work.Deal(start.have_samples);
  work.Serve([this](std::uint64_t first) { strategy.BeginWith(first); }, stop);
}

RunResult Runner::Result() {
  RunResult result;
  result.ranks = group.ranks();
  result.bytes_between_ranks = group.bytes();
  films.film().FitControl();
  static_cast<RunCounts&>(result) = Counts();
  result.stop_reason = watch.Reason();
  result.stopped_early = result.stop_reason == StopReason::kInterrupted;
  result.looks = checks.Count();
  strategy.Describe(result);
  result.control = films.film().Control();
  result.parts = EmptyParts();
  result.trace.start = ticks.start();
  result.trace.seconds_per_tick = ticks.SecondsPerTick();
  tasks.AddCounts(result);
  return result;
}

}  // namespace

const char* Name(StopReason reason) {
  static constexpr const char* kNames[] = {"samples", "time", "target", "interrupted",
                                           "hopeless"};
  return kNames[static_cast<int>(reason)];
}

RunResult Run(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.spp > 0 || options.seconds > 0 || options.samples_needed ||
           options.stop != nullptr);
  const ThreadLimit threads(options.threads);
  Runner run(scene, plan, options, film);
  run.Start();
  RunKeeper* const keeper = options.keeper;
  while (const auto part = run.parts.Next()) {
    run.strategy.BeginWith(part->first);
    const RoundWork round = {part->first, part->end, part->per_task};
    if (run.group.ranks() == 1) {
      run.tasks.RunRound(round, run.watch, run.films);
    } else {
      run.work.RunRound(round, run.watch);
    }
    if (keeper != nullptr && keeper->Due() && !run.watch.Ended()) run.Keep(false);
    if (run.show.Due() && !run.watch.Ended()) run.show.Show();
    // It may have been stopped before its end.
    if (run.tasks.Done() >= part->end) run.parts.Finish(*part);
  }
  run.watch.Report();
  run.work.Gather();
  // The last state is kept too, also where another rank has failed.
  if (keeper != nullptr) run.Keep(run.watch.Reason() != StopReason::kInterrupted);
  run.work.Dismiss();
  return run.Result();
}

void ServeRun(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.group != nullptr);
  const RunStart start = RunStartFromBytes(options.group->Share(""));
  RunOptions own = options;
  own.tiles = start.tiles;
  const ThreadLimit threads(options.threads);
  Runner(scene, plan, own, film).Serve(start, options.stop);
}

}  // namespace lanelight
