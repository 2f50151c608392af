#include "src/render/run/run.h"

#include <memory>
#include <optional>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/clock.h"
#include "src/base/core/parallel.h"
#include "src/render/ranks/rank_messages.h"
#include "src/render/ranks/rank_work.h"
#include "src/render/run/run_schedule.h"
#include "src/render/run/run_strategy.h"
#include "src/render/run/run_watch.h"
#include "src/render/wave/profile.h"
#include "src/scene/compiled/view.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

// A run from its start to its result. Members are initialised in order; each holds
// references to earlier ones.
struct Runner {
  Runner(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
         FilmAccumulator& film)
      : scene(scene),
        strategy(scene, plan, options, clock),
        films(strategy.run().planes, scene.strategy.coefficient.value_or(1), film),
        threads(scene, strategy.plan(), strategy.run(), options, films) {
    LL_CHECK_EQ(film.groups().replicates, GroupsOf(scene.strategy).replicates);
    LL_CHECK_EQ(film.groups().unit, GroupsOf(scene.strategy).unit);
    films.UseResponse(scene.view->film.response);
    MakeRoomForSplats();
    min_tile_side = scene.strategy.MayShare() ? kReuseTile : 1;
    if (options.group != nullptr && options.group->ranks() > 1) {
      LL_CHECK(options.windows.empty());
      ranks = std::make_unique<RankWork>(*options.group, clock, threads, films);
    }
    context.emplace(RunContext{options, clock, films, threads, Work()});
    schedule.emplace(*context);
    watch.emplace(*context, *schedule);
  }

  void Start();
  void MakeRoomForSplats();
  void Save(bool finished);
  RunResult Result();
  /// All of a run, for a worker.
  void Serve(const RunStart& start, const std::atomic<bool>* stop);

  RoundRunner& Work() {
    if (ranks) return *ranks;
    return threads;
  }
  RankGroup& Group() { return ranks ? *context->options.group : alone; }
  bool Restore();
  RunCounts Counts();

  const PreparedScene& scene;
  RunClock clock;
  RankGroup alone;
  RunStrategy strategy;
  Films films;
  ThreadWork threads;
  std::unique_ptr<RankWork> ranks;  // null: one process
  int min_tile_side = 1;
  std::optional<RunContext> context;
  std::optional<RunSchedule> schedule;
  std::optional<RunWatch> watch;
  TickScale ticks;  // the last to be made: a trace begins when the run does
};

// Light subpaths may be what a trial run has chosen.
void Runner::MakeRoomForSplats() {
  if (!strategy.plan().features.Has(Feature::kLightPaths)) return;
  if (films.film().splats() == nullptr) films.film().UseSplats(SplatUnit(scene));
}

// Starts the clock, and trains the strategy or resumes the run.
void Runner::Start() {
  clock.Start();
  const bool restored = context->options.checkpointer != nullptr && Restore();
  RunStart start;
  start.have_samples = threads.Counts().samples > 0;
  start.planned_training = restored ? 0 : strategy.PlannedTraining();
  if (ranks) {
    start.tiles = threads.scheduler().tiles();
    Group().Share(ToBytes(start));
  }
  if (start.planned_training > 0) strategy.Train(start.planned_training, Group());
  MakeRoomForSplats();
  films.film().set_dependents(strategy.Dependents());
  if (ranks) {
    Group().Share(ToBytes(
        RunTraining{strategy.trained(), strategy.training().changes, strategy.Tables()}));
    ranks->AssignTiles(start.have_samples, min_tile_side);
  }
  watch->Start();
  schedule->Start(restored);
}

bool Runner::Restore() {
  RunState state = {{}, films};
  if (!context->options.checkpointer->Restore(state)) return false;
  clock.StartAt(state.counts.seconds);
  threads.Resume(state.counts);
  if (!state.trained) return !NeedsTraining(strategy.plan());
  strategy.Restore(std::move(state.training), state.tables);
  return true;
}

void Runner::Save(bool finished) {
  Work().Gather();
  RunState state = {
      {Counts(), strategy.trained(), strategy.training(), strategy.Tables()},
      films,
      finished};
  context->options.checkpointer->Save(state);
}

RunCounts Runner::Counts() {
  RunCounts counts = Work().Counts();
  counts.seconds = clock.Elapsed();
  // Earlier time, and that of other ranks, is included already.
  counts.cpu_seconds += clock.CpuSeconds();
  return counts;
}

void Runner::Serve(const RunStart& start, const std::atomic<bool>* stop) {
  clock.Start();
  if (start.planned_training > 0) strategy.Train(start.planned_training, Group());
  // Uses the leader's training bit by bit, also if other processors round elementary
  // functions differently.
  const RunTraining learned = RunTrainingFromBytes(Group().Share(""));
  if (learned.trained) {
    TrainingOutcome training;
    training.changes = learned.changes;
    strategy.Restore(std::move(training), learned.tables);
  }
  MakeRoomForSplats();
  ranks->AssignTiles(start.have_samples, min_tile_side);
  ranks->Serve([this](const Round& round) { strategy.SetFirstSample(round.begin); },
               stop);
}

RunResult Runner::Result() {
  RunResult result;
  result.ranks = Group().ranks();
  result.bytes_between_ranks = Group().bytes();
  films.film().FitControl();
  static_cast<RunCounts&>(result) = Counts();
  result.stop_reason = watch->Reason();
  result.stopped_early = result.stop_reason == StopReason::kInterrupted;
  result.num_checks = schedule->Checks();
  strategy.Describe(result);
  result.control = films.film().Control();
  result.parts = EmptyParts();
  result.trace.start = ticks.start();
  result.trace.seconds_per_tick = ticks.SecondsPerTick();
  threads.AddProfile(result);
  return result;
}

}  // namespace

const char* Name(StopReason reason) {
  static constexpr const char* kNames[] = {"samples", "time", "target", "interrupted",
                                           "hopeless"};
  return kNames[int(reason)];
}

RunResult Run(const PreparedScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.spp > 0 || options.seconds > 0 || options.samples_needed ||
           options.stop != nullptr);
  const ThreadLimit threads(options.threads);
  Runner run(scene, plan, options, film);
  run.Start();
  Checkpointer* const checkpointer = options.checkpointer;
  while (!run.watch->HasEnded()) {
    const auto round = run.schedule->Next();
    if (!round) break;
    run.strategy.SetFirstSample(round->begin);
    run.Work().RunRound(*round, *run.watch);
    if (!run.watch->HasEnded()) {
      if (checkpointer != nullptr && checkpointer->IsDue()) run.Save(false);
      run.watch->ShowIfDue();
    }
    // The round may have been stopped before its end.
    if (run.Work().Done() >= round->end) run.schedule->Finish(*round);
  }
  run.watch->Report();
  run.Work().Gather();
  // The last state is kept too, also where another rank has failed.
  if (checkpointer != nullptr) run.Save(run.watch->Reason() != StopReason::kInterrupted);
  run.Work().Finish();
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
