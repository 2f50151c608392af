// Once its memory is there, a wavefront neither allocates nor locks, with and without a
// profile.
#include <catch2/catch.hpp>
#include <memory>
#include <mutex>

#include "tests/agreement/all_stages_scene.h"
#include "tests/render/wave/interposed.h"
#include "tests/render/wave/task_fixture.h"

namespace lanelight {
namespace {

// A stage that does what none must, every so many waves.
StageFn honest_stage = nullptr;
int waves = 0;
bool plant_allocation = false, plant_lock = false;
std::mutex mutex;
int* volatile leak = nullptr;

void PlantedStage(Wave& wave) {
  honest_stage(wave);
  if (++waves % 8 != 0) return;
  if (plant_allocation) {
    leak = new int(waves);
    delete leak;
  }
  if (plant_lock) {
    const std::lock_guard lock(mutex);
    leak = nullptr;
  }
}

void Plant(Plan& plan) {
  honest_stage = plan.paths().stages.front().kernel;
  plan.phases[0].stages.front().kernel = PlantedStage;
  waves = 0;
}

// The first task warms up, the second is counted.
InterposedCalls CallsOfSecondTask(TaskFixture& task, StageClock* clock) {
  task.Run(clock);
  waves = 0;
  const CountCalls count;
  task.Run(clock);
  return count.calls();
}

bool Skip() {
  if (CanInterpose()) return false;
  WARN("skipped: malloc and pthread_mutex_lock cannot be counted in this build");
  return true;
}

}  // namespace

TEST_CASE("wavefronts neither allocate nor lock", "[steady]") {
  if (Skip()) return;
  for (const std::string& scene : {std::string(kAllStagesScene), MeshScene()}) {
    for (const char* strategy :
         {"points=sobol", "points=independent,light-selection=tree",
          "points=halton,directions=light,pairs=antithetic",
          "points=sobol,control=regression",
          "points=halton,roulette=none,control=regression", "points=stratified",
          "roulette=adjoint"}) {
      INFO(strategy);
      TaskFixture task(scene, strategy, Auxiliary::kGbuffer);
      Plant(task.plan);
      plant_allocation = plant_lock = false;
      const InterposedCalls untimed = CallsOfSecondTask(task, nullptr);
      CHECK(waves > 16);
      CHECK(untimed.allocations == 0);
      CHECK(untimed.locks == 0);
      ProfileOptions profile;
      profile.trace_events = 100;  // the buffer fills up on the way
      StageClock clock(task.plan.paths().stages.size(), profile);
      const InterposedCalls timed = CallsOfSecondTask(task, &clock);
      CHECK(timed.allocations == 0);
      CHECK(timed.locks == 0);
      CHECK(clock.dropped() > 0);
    }
  }
}

TEST_CASE("an allocation or a lock in a wavefront is noticed", "[steady]") {
  if (Skip()) return;
  TaskFixture task(kAllStagesScene, "points=sobol", Auxiliary::kNone);
  Plant(task.plan);
  plant_allocation = true, plant_lock = false;
  const InterposedCalls allocating = CallsOfSecondTask(task, nullptr);
  CHECK(allocating.allocations == static_cast<std::uint64_t>(waves / 8));
  CHECK(allocating.locks == 0);
  plant_allocation = false, plant_lock = true;
  const InterposedCalls supports_locks = CallsOfSecondTask(task, nullptr);
  CHECK(supports_locks.allocations == 0);
  CHECK(supports_locks.locks == static_cast<std::uint64_t>(waves / 8));
  plant_lock = false;
}

}  // namespace lanelight
