// Once its memory is there, a wavefront neither allocates nor locks, with and without a
// profile.
#include <catch2/catch.hpp>
#include <memory>
#include <mutex>

#include "src/strategy/path_values.h"
#include "src/strategy/tables.h"
#include "src/wavefront/drive.h"
#include "src/wavefront/pilot.h"
#include "src/wavefront/tiles.h"
#include "tests/wavefront/all_stages_scene.h"
#include "tests/wavefront/interposed.h"
#include "tests/wavefront/render_fixture.h"

namespace lanelight {
namespace {

const char* kMesh = R"(
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Shape "trianglemesh" "point3 P" [ -1 2 3  1 2 3  1 2 5 ] "integer indices" [ 0 2 1 ]
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.6 0.6 0.6 ]
)";

// Enough triangles in space for a tree.
std::string MeshScene() {
  std::string points, indices;
  for (int i = 0; i < 400; ++i) {
    const double x = i % 20 * 0.2 - 2, y = i / 20 * 0.2 - 2, z = 4 + 0.3 * (i % 7);
    points += fmt::format("{} {} {} {} {} {} {} {} {} ", x, y, z, x + 0.3, y, z, x,
                          y + 0.3, z + 0.1);
    indices += fmt::format("{} {} {} ", 3 * i, 3 * i + 1, 3 * i + 2);
  }
  return std::string(kMesh) + "Shape \"trianglemesh\" \"point3 P\" [ " + points +
         "] \"integer indices\" [ " + indices + "]\n";
}

// What a task of a render does (src/wavefront/tasks.cc), with a plan to tamper with.
class TaskFixture {
 public:
  TaskFixture(const std::string& text, const std::string& strategy, bool aov)
      : scene_(CompileScene(ParseSceneText(text, "test.pbrt", "."), {})) {
    Strategy s = scene_.strategy;
    ApplyStrategy(strategy, {}, s);
    UseStrategy(s, scene_);
    PlanOptions options;
    options.max_depth = 6;
    options.aov = aov;
    options.wavefront = 256;
    plan = MakePlan(scene_, options);
    tables_ = MakeStrategyTables(scene_);
    run_ = MakeRunParameters(scene_, plan, GroupSize(scene_.strategy, kSamples));
    run_.spp = kSamples;
    run_.tables = &tables_;
    copies_ = plan.features.Has(Feature::kSplitting) ? kMostCopies : 1;
    if (copies_ > 1) MakePilotTables();
    wavefront_ = std::make_unique<Wavefront>(scene_, plan, run_);
    TilePixels({0, 0, 32, 32}, 32, &pixels_);
    buffer_.resize(std::size_t{Rows()} * kPlanes);
  }

  /// Waves are counted by how often the first stage runs.
  void Run(StageClock* clock) {
    TileWork work;
    work.pixels = pixels_.data();
    work.num_pixels = static_cast<std::uint32_t>(pixels_.size());
    work.samples = kSamples;
    work.together = kSamples;
    if (clock) clock->StartTask();
    Drive(*wavefront_, plan, work, {buffer_.data(), Rows()}, clock);
    if (clock) clock->EndTask();
  }

  Plan plan;

 private:
  static constexpr std::uint32_t kSamples = 4;
  static constexpr int kPlanes = 24;  // more than any strategy has

  std::uint32_t Rows() const { return 32 * 32 * kSamples * copies_; }

  // What the roulettes that split go by.
  void MakePilotTables() {
    PilotOptions options;
    options.planned_samples = 100000;
    options.keep_roulette = true;
    RunPilot(scene_, plan, run_, options, tables_);
  }

  CompiledScene scene_;
  StrategyTables tables_;
  RunParameters run_;
  std::uint32_t copies_ = 1;
  std::unique_ptr<Wavefront> wavefront_;
  std::vector<std::uint32_t> pixels_;
  std::vector<float> buffer_;
};

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
  honest_stage = plan.stages.front().kernel;
  plan.stages.front().kernel = PlantedStage;
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
         {"points=sobol", "points=independent,light-selection=tree", "points=pmj02",
          "points=halton,directions=light,pairs=antithetic",
          "points=cmj,control=analytic",
          "points=lattice,roulette=luminance,control=regression", "points=stratified",
          "roulette=efficiency"}) {
      INFO(strategy);
      TaskFixture task(scene, strategy, true);
      Plant(task.plan);
      plant_allocation = plant_lock = false;
      const InterposedCalls untimed = CallsOfSecondTask(task, nullptr);
      CHECK(waves > 16);
      CHECK(untimed.allocations == 0);
      CHECK(untimed.locks == 0);
      ProfileOptions profile;
      profile.trace_events = 100;  // the buffer fills up on the way
      StageClock clock(task.plan.stages.size(), profile);
      const InterposedCalls timed = CallsOfSecondTask(task, &clock);
      CHECK(timed.allocations == 0);
      CHECK(timed.locks == 0);
      CHECK(clock.dropped() > 0);
    }
  }
}

TEST_CASE("an allocation or a lock in a wavefront is noticed", "[steady]") {
  if (Skip()) return;
  TaskFixture task(kAllStagesScene, "points=sobol", false);
  Plant(task.plan);
  plant_allocation = true, plant_lock = false;
  const InterposedCalls allocating = CallsOfSecondTask(task, nullptr);
  CHECK(allocating.allocations == static_cast<std::uint64_t>(waves / 8));
  CHECK(allocating.locks == 0);
  plant_allocation = false, plant_lock = true;
  const InterposedCalls locking = CallsOfSecondTask(task, nullptr);
  CHECK(locking.allocations == 0);
  CHECK(locking.locks == static_cast<std::uint64_t>(waves / 8));
  plant_lock = false;
}

}  // namespace lanelight
