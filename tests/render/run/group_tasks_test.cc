// What the leader knows of tiles that other ranks have, and what they are told.
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "src/render/run/group_tasks.h"
#include "src/scene/prepare/tables.h"
#include "tests/render/run/lamp_scene.h"
#include "tests/render/run/render_fixture.h"
#include "tests/render/run/thread_group.h"

namespace lanelight {
namespace {

constexpr int kSide = 40;
constexpr std::uint64_t kPixels = kSide * kSide;

// The first stage of a plan, that workers are slow in.
std::atomic<StageFn> quick_stage{nullptr};
std::atomic<bool> workers_are_slow{false};

void SlowStage(Wave& wave) {
  if (workers_are_slow) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  quick_stage.load()(wave);
}

// All that the tasks of one rank need.
struct RankFixture {
  PreparedScene scene =
      PrepareScene(ParseSceneText(LampScene(kSide, kSide, 4), "test.pbrt", "."), {});
  Plan plan = MakePlan(scene, {});
  StrategyTables tables = MakeStrategyTables(scene);
  RunParameters run = MakeRunParameters(scene, plan);
  RunOptions options;
  FilmAccumulator film{0, 0, kSide, kSide, GroupsOf(scene.strategy), Auxiliary::kNone};
  Films films{run.planes, 1, film};
  RunClock clock;
  Tasks tasks{scene, plan, run, options, 32};

  RankFixture() {
    run.tables = &tables;
    quick_stage = plan.stages[0].kernel;
    clock.Start();
  }
};

// Stops after so many tasks.
struct CountingWatch : TaskWatcher {
  explicit CountingWatch(int most) : left(most) {}
  bool Stopped() const override { return left <= 0; }
  void TaskDone() override { --left; }
  std::atomic<int> left;
};

}  // namespace

TEST_CASE("tiles of all ranks count when a run goes on", "[ranks]") {
  const ThreadLimit limit(1);
  RankFixture fixture;
  RunOptions corner;
  corner.tiles = {{0, 0, 2, 2}};
  Tasks some(fixture.scene, fixture.plan, fixture.run, corner, 32);
  CountingWatch watch(1 << 30);
  some.RunRound({0, 2, 2}, watch, fixture.films);
  for (int rank = 0; rank < 3; ++rank) {
    Tasks tasks(fixture.scene, fixture.plan, fixture.run, fixture.options, 32);
    tasks.GoOn(fixture.films, {});
    tasks.Deal({1, 1, 1}, rank, fixture.films);
    CHECK(tasks.Held().size() == (tasks.tiles().size() + 2 - std::size_t(rank)) / 3);
    CHECK(tasks.pixels() == kPixels);
    CHECK(tasks.Done() == 0);
    // One of them has the corner, and the others know.
    CHECK(tasks.Levels().most == (rank == 0 ? 2 : 0));
    CHECK_FALSE(tasks.IsAt(0));
  }
}

TEST_CASE("the leader knows what other ranks have not done", "[ranks]") {
  const ThreadLimit limit(1);
  workers_are_slow = true;
  OnRanks(3, [](RankGroup& group) {
    RankFixture own;
    if (!group.leads()) own.plan.stages[0].kernel = SlowStage;
    GroupTasks work(group, own.clock, own.tasks, own.films);
    work.Deal(false);
    if (!group.leads()) {
      std::vector<std::uint64_t> firsts;
      work.Serve([&](std::uint64_t first) { firsts.push_back(first); }, nullptr);
      if (firsts != std::vector<std::uint64_t>{0, 0, 12})
        throw std::runtime_error("first");
      return;
    }
    CountingWatch hasty(static_cast<int>(own.tasks.Held().size()));
    work.RunRound({0, 4, 4}, hasty);
    CHECK(own.tasks.Levels().least == 4);
    CHECK(own.tasks.Done() == 0);
    workers_are_slow = false;
    CountingWatch patient(1 << 30);
    work.RunRound({0, 12, 4}, patient);
    CHECK(own.tasks.Done() == 12);
    CHECK(own.tasks.IsAt(12));
    CHECK(own.tasks.taken() == 12 * kPixels);
    CHECK(own.tasks.counts().samples < 12 * kPixels);
    work.RunRound({12, 16, 4}, patient);
    work.Gather();
    CHECK(own.tasks.counts().samples == 16 * kPixels);
    CHECK(own.film.Samples(kSide - 1, kSide - 1) == 16);
    work.Dismiss();
  });
}

TEST_CASE("a fast rank takes tiles from a slow one, and the bits stay", "[ranks]") {
  const ThreadLimit limit(1);
  constexpr std::uint64_t kSpp = 32;
  RankFixture alone;
  CountingWatch watch(1 << 30);
  alone.tasks.RunRound({0, kSpp, 4}, watch, alone.films);
  workers_are_slow = true;
  OnRanks(3, [&alone](RankGroup& group) {
    RankFixture own;
    if (!group.leads()) own.plan.stages[0].kernel = SlowStage;
    GroupTasks work(group, own.clock, own.tasks, own.films);
    work.Deal(false);
    if (!group.leads()) return work.Serve([](std::uint64_t) {}, nullptr);
    const std::uint64_t dealt = own.tasks.Missing(own.tasks.Held(), kSpp);
    CHECK(dealt < kSpp * kPixels / 2);
    CountingWatch patient(1 << 30);
    work.RunRound({0, kSpp, 4}, patient);
    CHECK(own.tasks.own_taken() > 3 * dealt / 2);
    work.Gather();
    CHECK(own.tasks.counts().samples == kSpp * kPixels);
    CHECK(own.tasks.IsAt(kSpp));
    CHECK(Identical(own.film, alone.film));
    work.Dismiss();
  });
  workers_are_slow = false;
}

}  // namespace lanelight
