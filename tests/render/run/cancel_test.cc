// Endless paths: tasks in flight are cancelled, and nothing else changes.
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "src/render/schedule/thread_work.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/prepare/tables.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight {
namespace {

// A white room with a hole in the wall, through which the left half of the image, and a
// little more, sees the sky. A path in the room takes 250 000 events to find it.
const char* kScene = R"(
Camera "perspective" "float fov" 1.146
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
Integrator "path" "integer maxdepth" 1000000 "string strategy" "roulette=none"
WorldBegin
LightSource "infinite" "rgb L" [ 1 2 3 ]
Material "diffuse" "rgb reflectance" [ 1 1 1 ]
Shape "trianglemesh"
  "point3 P" [ -3 -3 -5  3 -3 -5  3 3 -5  -3 3 -5  -3 -3 1  3 -3 1  3 3 1  -3 3 1
               -0.02 -0.02 1  0.002 -0.02 1  0.002 0.02 1  -0.02 0.02 1 ]
  "integer indices" [ 0 1 2  0 2 3  0 1 5  0 5 4  1 2 6  1 6 5  2 3 7  2 7 6  3 0 4  3 4 7
                      4 5 9  4 9 8  5 6 10  5 10 9  6 7 11  6 11 10  7 4 8  7 8 11 ]
)";

struct Watcher : TaskWatcher {
  bool IsStopped() const override { return false; }
  void TaskDone() override { ++done; }
  bool IsCancelled() const override { return ++polls > after; }
  std::atomic<int> done{0};
  mutable std::atomic<int> polls{0};
  int after = 0;
};

std::uint64_t PixelsWith(const FilmAccumulator& film, std::uint64_t samples) {
  std::uint64_t count = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) count += film.Samples(x, y) == samples;
  }
  return count;
}

Rendered Run(const RunOptions& options) {
  const ThreadLimit limit(2);
  const PreparedScene scene = PrepareScene(ParseSceneText(kScene, "test.pbrt", "."), {});
  PlanOptions plan_options;
  plan_options.max_depth = 1000000;
  const Plan plan = MakePlan(scene, plan_options);
  Rendered out{FilmAccumulator(0, 0, 32, 32, GroupsOf(scene.strategy), Auxiliary::kNone),
               {},
               plan};
  out.result = lanelight::Run(scene, plan, options, out.film);
  return out;
}

}  // namespace

TEST_CASE("a time limit ends half a second after a stop", "[put_down]") {
  TimeLimit limit;
  CHECK_FALSE(limit.IsOver(false, false, 1e9));
  CHECK_FALSE(limit.IsOver(true, false, 7));
  limit.NoteTaskEnd(7.4);
  CHECK_FALSE(limit.IsOver(true, false, 7.4));
  CHECK(limit.IsOver(true, false, 7.6));
}

TEST_CASE("a time limit with a budget waits for the first samples", "[put_down]") {
  TimeLimit limit(2);
  CHECK(limit.Wait() == 2);
  CHECK_FALSE(limit.IsOver(false, true, 1.9));
  CHECK_FALSE(limit.IsOver(false, true, 2.4));
  CHECK(limit.IsOver(false, true, 2.6));
  CHECK_FALSE(limit.IsOver(false, false, 3.9));
  CHECK(limit.IsOver(false, false, 4.1));
  limit.NoteTaskEnd(4.0);
  CHECK_FALSE(limit.IsOver(false, false, 5.9));
  CHECK(limit.IsOver(false, false, 6.1));
  CHECK(TimeLimit(0.1).Wait() == 1);
  CHECK(TimeLimit(1000).Wait() == 10);
  // One that goes on after its time.
  CHECK_FALSE(TimeLimit(2, 50).IsOver(false, false, 51));
}

TEST_CASE("a stop cancels unfinished paths and keeps finished ones", "[put_down]") {
  std::atomic<bool> stop{false};
  RunOptions options;
  options.spp = 1'000'000;
  options.stop = &stop;
  std::thread signal([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop = true;
  });
  const Rendered r = Run(options);
  signal.join();
  CHECK(r.result.stop_reason == StopReason::kInterrupted);
  std::uint64_t pixels = 0, samples = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      samples += r.film.Samples(x, y);
      if (r.film.Samples(x, y) == 0) continue;
      ++pixels;
      // All that a path can end in is the sky, after however many events.
      REQUIRE(r.film.Mean(x, y).y == Approx(2).epsilon(0.02));
    }
  }
  CHECK(pixels > 0);
  CHECK(pixels < 1024);
  CHECK(r.result.samples == samples);
}

TEST_CASE("a time budget ends although paths do not", "[put_down]") {
  RunOptions options;
  options.seconds = 0.05;
  const Rendered r = Run(options);
  CHECK(r.result.stop_reason == StopReason::kTime);
  // Finished tasks are there; how much of the rest is there depends on the machine.
  CHECK(PixelsWith(r.film, 0) <= 512);
}

TEST_CASE("a cancelled task leaves no trace", "[put_down]") {
  const ThreadLimit limit(1);
  PreparedScene scene = PrepareScene(ParseSceneText(R"(
Camera "perspective"
Film "rgb" "integer xresolution" 40 "integer yresolution" 24
Integrator "path" "integer maxdepth" 20
WorldBegin
LightSource "infinite"
Material "diffuse" "rgb reflectance" [ 0.5 0.6 0.7 ]
Shape "sphere" "float radius" 3
)",
                                                    "test.pbrt", "."),
                                     {});
  PlanOptions plan_options;
  plan_options.max_depth = 20;
  const Plan plan = MakePlan(scene, plan_options);
  const StrategyTables tables;
  RunParameters run = MakeRunParameters(scene, plan);
  run.tables = &tables;
  RunOptions options;
  options.spp = 32;
  const auto render = [&](const std::vector<int>& put_down_after) {
    FilmAccumulator film(0, 0, 40, 24, GroupsOf(scene.strategy), Auxiliary::kNone);
    Films films(run.planes, 1, film);
    ThreadWork work(scene, plan, run, options, films);
    for (const std::uint64_t limit_spp : {20u, 64u}) {
      for (const int after : put_down_after) {
        Watcher watcher;
        watcher.after = after;
        work.RunRound({0, limit_spp, 8}, watcher);
      }
      Watcher patient;
      patient.after = 1 << 30;
      work.RunRound({0, limit_spp, 8}, patient);
    }
    CHECK(work.Done() == 64);
    CHECK(work.Counts().samples == 40 * 24 * 64);
    CHECK(work.RenderedSamples() == 40 * 24 * 64);
    return film;
  };
  const FilmAccumulator whole = render({});
  CHECK(Identical(whole, render({0})));
  CHECK(Identical(whole, render({0, 3, 40, 7, 100})));
}

}  // namespace lanelight
