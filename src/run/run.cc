#include "src/run/run.h"

#include <utility>

#include "src/core/check.h"
#include "src/core/clock.h"
#include "src/core/parallel.h"
#include "src/prepare/groups.h"
#include "src/run/error_looks.h"
#include "src/wave/profile.h"
#include "src/run/run_parts.h"
#include "src/run/run_setting.h"
#include "src/run/run_start.h"
#include "src/run/run_strategy.h"
#include "src/run/run_watch.h"

namespace lanelight {

namespace {

// Without a sample count the partition assumes many samples.
std::uint64_t PlannedSpp(const RunOptions& options) {
  const bool open_ended = options.seconds > 0 || options.samples_needed;
  return open_ended || options.spp == 0 ? kPilotSpp : options.spp;
}

class Runner {
 public:
  Runner(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
         FilmAccumulator& film)
      : group_(options.group != nullptr ? *options.group : alone_),
        strategy_(scene, plan, options, clock_),
        tasks_(scene, strategy_.plan(), strategy_.run(), options, PlannedSpp(options)),
        films_(strategy_.run().planes, scene.strategy.coefficient.value_or(1), film),
        work_(group_, clock_, tasks_, films_),
        setting_{options, clock_, tasks_, films_, work_},
        looks_(setting_),
        watch_(setting_, looks_),
        parts_(setting_, looks_, watch_) {
    LL_CHECK_EQ(film.groups().replicates, GroupsOf(scene.strategy).replicates);
    LL_CHECK_EQ(film.groups().unit, GroupsOf(scene.strategy).unit);
    films_.UseResponse(scene.film.response);
    LL_CHECK(options.windows.empty() || group_.ranks() == 1);
  }

  /// All of a run.
  RunResult Run();
  /// The same for a worker.
  void Serve(const RunStart& start, const std::atomic<bool>* stop);

 private:
  void Start();
  bool Restore();
  void Keep(bool finished);
  RunCounts Counts() const;
  RunResult Result();

  RunClock clock_;
  RankGroup alone_;
  RankGroup& group_;
  RunStrategy strategy_;
  Tasks tasks_;
  Films films_;
  GroupTasks work_;
  const RunSetting setting_;
  ErrorLooks looks_;
  RunWatch watch_;
  RunParts parts_;
  TickScale ticks_;  // the last to be made: a trace begins when the run does
};

// Starts the clock, and trains the strategy or goes on where a run was put down.
void Runner::Start() {
  clock_.Start();
  const bool restored = setting_.options.keeper != nullptr && Restore();
  if (!restored) strategy_.Train();
  films_.film().set_dependents(strategy_.Dependents());
  const bool have_samples = tasks_.counts().samples > 0;
  if (group_.ranks() > 1) {
    group_.Share(ToBytes({tasks_.tiles(), have_samples, strategy_.trained(),
                          strategy_.training().changes, strategy_.Tables()}));
  }
  work_.Deal(have_samples);
  parts_.Start();
  watch_.Start();
  if (restored) looks_.LookAgain();
}

bool Runner::Restore() {
  RunState state = {{}, films_};
  if (!setting_.options.keeper->Restore(state)) return false;
  clock_.GoOn(state.counts.seconds);
  tasks_.GoOn(films_, state.counts);
  if (!state.trained) return !strategy_.NeedsTraining();
  strategy_.Restore(std::move(state.training), state.tables);
  return true;
}

void Runner::Keep(bool finished) {
  work_.Gather();
  RunState state = {
      {Counts(), strategy_.trained(), strategy_.training(), strategy_.Tables()},
      films_,
      finished};
  setting_.options.keeper->Keep(state);
}

RunCounts Runner::Counts() const {
  RunCounts counts = tasks_.counts();
  counts.seconds = clock_.Elapsed();
  // What came before, and of other ranks, is in it already.
  counts.cpu_seconds += clock_.CpuSeconds();
  return counts;
}

RunResult Runner::Run() {
  Start();
  RunKeeper* const keeper = setting_.options.keeper;
  while (const auto part = parts_.Next()) {
    strategy_.BeginWith(part->first);
    work_.RunRound({part->first, part->end, part->per_task}, watch_);
    if (keeper != nullptr && keeper->Due() && !watch_.Ended()) Keep(false);
    // It may have been stopped before its end.
    if (tasks_.Done() >= part->end) parts_.Finish(*part);
  }
  work_.Gather();
  // The last state is kept too, also where another rank has failed.
  if (keeper != nullptr) Keep(watch_.Reason() != StopReason::kInterrupted);
  work_.Dismiss();
  return Result();
}

void Runner::Serve(const RunStart& start, const std::atomic<bool>* stop) {
  clock_.Start();
  if (start.trained) {
    TrainingOutcome training;
    training.changes = start.changes;
    strategy_.Restore(std::move(training), start.tables);
  }
  work_.Deal(start.have_samples);
  work_.Serve([this](std::uint64_t first) { strategy_.BeginWith(first); }, stop);
}

RunResult Runner::Result() {
  RunResult result;
  result.ranks = group_.ranks();
  result.bytes_between_ranks = group_.bytes();
  films_.film().FitControl();
  static_cast<RunCounts&>(result) = Counts();
  result.stop_reason = watch_.Reason();
  result.stopped_early = result.stop_reason == StopReason::kInterrupted;
  result.looks = looks_.Count();
  strategy_.Describe(result);
  result.control = films_.film().Control();
  result.parts = EmptyParts();
  result.trace.start = ticks_.start();
  result.trace.seconds_per_tick = ticks_.SecondsPerTick();
  tasks_.AddCounts(result);
  return result;
}

}  // namespace

const char* Name(StopReason reason) {
  static constexpr const char* kNames[] = {"samples", "time", "target", "interrupted",
                                           "hopeless"};
  return kNames[static_cast<int>(reason)];
}

RunResult Run(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.spp > 0 || options.seconds > 0 || options.samples_needed ||
           options.stop != nullptr);
  const ThreadLimit threads(options.threads);
  return Runner(scene, plan, options, film).Run();
}

void ServeRun(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.group != nullptr);
  const RunStart start = RunStartFromBytes(options.group->Share(""));
  RunOptions own = options;
  own.tiles = start.tiles;
  const ThreadLimit threads(options.threads);
  Runner(scene, plan, own, film).Serve(start, options.stop);
}

}  // namespace lanelight
