// What the leader knows of tiles that other ranks have, and what they are told.
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "src/render/ranks/rank_work.h"
#include "src/scene/prepare/tables.h"
#include "tests/render/ranks/thread_group.h"
#include "tests/render/run/lamp_scene.h"
#include "tests/render/run/render_fixture.h"

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

RunOptions Samples(std::uint64_t spp) {
  RunOptions options;
  options.spp = spp;
  return options;
}

// All that the work of one rank needs.
struct RankFixture {
  PreparedScene scene =
      PrepareScene(ParseSceneText(LampScene(kSide, kSide, 4), "test.pbrt", "."), {});
  Plan plan = MakePlan(scene, {});
  StrategyTables tables;
  RunParameters run = MakeRunParameters(scene, plan);
  RunOptions options = Samples(32);
  FilmAccumulator film{0, 0, kSide, kSide, GroupsOf(scene.strategy), Auxiliary::kNone};
  Films films{run.planes, 1, film};
  RunClock clock;
  ThreadWork threads{scene, plan, run, options, films};

  RankFixture() {
    run.tables = &tables;
    quick_stage = plan.paths().stages[0].kernel;
    clock.Start();
  }
};

std::uint64_t MissingSamples(ThreadWork& threads, std::uint64_t spp) {
  return threads.scheduler().MissingSamples(threads.scheduler().Snapshot(), spp);
}

// Fails the rank of this thread.
void Expect(bool holds) {
  if (!holds) throw std::runtime_error("expectation of a rank");
}

// Stops after so many tasks.
struct CountingWatch : TaskWatcher {
  explicit CountingWatch(int maximum) : left(maximum) {}
  bool IsStopped() const override { return left <= 0; }
  void TaskDone() override { --left; }
  std::atomic<int> left;
};

}  // namespace

TEST_CASE("tiles of all ranks count when a run resumes", "[ranks]") {
  const ThreadLimit limit(1);
  RankFixture fixture;
  RunOptions corner = fixture.options;
  corner.tiles = {{0, 0, 2, 2}};
  ThreadWork some(fixture.scene, fixture.plan, fixture.run, corner, fixture.films);
  CountingWatch watch(1 << 30);
  some.RunRound({0, 2, 2}, watch);
  OnRanks(3, [&fixture](RankGroup& group) {
    RankFixture own;
    for (std::size_t i = 0; i < own.films.Columns().size(); ++i) {
      const MutableStateColumn from = fixture.films.Columns()[i];
      std::memcpy(own.films.Columns()[i].data, from.data, from.Bytes());
    }
    own.threads.Resume({});
    RankWork work(group, own.clock, own.threads, own.films);
    work.AssignTiles(false, 1);
    const auto rank = static_cast<std::size_t>(group.rank());
    const Scheduler& scheduler = own.threads.scheduler();
    Expect(scheduler.Snapshot().size() == (scheduler.tiles().size() + 2 - rank) / 3);
    std::uint64_t pixels = 0;
    for (const PixelRect& tile : scheduler.tiles()) pixels += tile.pixels();
    Expect(pixels == kPixels);
    Expect(work.Done() == 0);
    // One of them has the corner, and the others know.
    Expect(own.threads.Levels().maximum == (rank == 0 ? 2 : 0));
    Expect(work.Levels().maximum == 2);
    Expect(!work.IsAt(0));
  });
}

TEST_CASE("the leader counts the remaining samples of other ranks", "[ranks]") {
  const ThreadLimit limit(1);
  workers_are_slow = true;
  OnRanks(3, [](RankGroup& group) {
    RankFixture own;
    if (!group.is_leader()) own.plan.phases[0].stages[0].kernel = SlowStage;
    RankWork work(group, own.clock, own.threads, own.films);
    work.AssignTiles(false, 1);
    if (!group.is_leader()) {
      std::vector<std::uint64_t> firsts;
      work.Serve([&](const Round& round) { firsts.push_back(round.begin); }, nullptr);
      if (firsts != std::vector<std::uint64_t>{0, 0, 12})
        throw std::runtime_error("first");
      return;
    }
    CountingWatch hasty(static_cast<int>(own.threads.scheduler().Snapshot().size()));
    work.RunRound({0, 4, 4}, hasty);
    CHECK(own.threads.Levels().minimum == 4);
    CHECK(work.Done() == 0);
    workers_are_slow = false;
    CountingWatch patient(1 << 30);
    work.RunRound({0, 12, 4}, patient);
    CHECK(work.Done() == 12);
    CHECK(work.IsAt(12));
    CHECK(work.RenderedSamples() == 12 * kPixels);
    CHECK(work.Counts().samples < 12 * kPixels);
    work.RunRound({12, 16, 4}, patient);
    work.Gather();
    CHECK(work.Counts().samples == 16 * kPixels);
    CHECK(own.film.Samples(kSide - 1, kSide - 1) == 16);
    work.Finish();
  });
}

TEST_CASE("moving tiles to a faster rank keeps the image bit-identical", "[ranks]") {
  const ThreadLimit limit(1);
  constexpr std::uint64_t kSpp = 32;
  RankFixture alone;
  CountingWatch watch(1 << 30);
  alone.threads.RunRound({0, kSpp, 4}, watch);
  workers_are_slow = true;
  OnRanks(3, [&alone](RankGroup& group) {
    RankFixture own;
    if (!group.is_leader()) own.plan.phases[0].stages[0].kernel = SlowStage;
    RankWork work(group, own.clock, own.threads, own.films);
    work.AssignTiles(false, 1);
    if (!group.is_leader()) return work.Serve([](const Round&) {}, nullptr);
    const std::uint64_t dealt = MissingSamples(own.threads, kSpp);
    CHECK(dealt < kSpp * kPixels / 2);
    CountingWatch patient(1 << 30);
    work.RunRound({0, kSpp, 4}, patient);
    CHECK(own.threads.RenderedSamples() > 3 * dealt / 2);
    work.Gather();
    CHECK(work.Counts().samples == kSpp * kPixels);
    CHECK(work.IsAt(kSpp));
    CHECK(Identical(own.film, alone.film));
    work.Finish();
  });
  workers_are_slow = false;
}

}  // namespace lanelight
