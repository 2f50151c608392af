// Copies of the scene in memory nodes: tasks read them, and nothing else changes. The
// nodes are made up of this machine's processors; what they save can only be seen where
// there are several.
#include "src/wavefront/scene_copies.h"

#include <sched.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <mutex>
#include <set>

#include "tests/wavefront/task_fixture.h"

namespace lanelight {
namespace {

// Half of the processors each; one that has none is there all the same.
MemoryNodes TwoNodes() {
  std::vector<std::vector<int>> processors(2);
  cpu_set_t set;
  REQUIRE(sched_getaffinity(0, sizeof(set), &set) == 0);
  std::size_t next = 0;
  for (int p = 0; p < CPU_SETSIZE; ++p) {
    if (CPU_ISSET(p, &set)) processors[next++ % 2].push_back(p);
  }
  return MemoryNodes(std::move(processors));
}

CompiledScene SomeScene() {
  const std::string sphere = "Translate 0 0 5 Shape \"sphere\"\n";
  return PrepareScene(ParseSceneText(MeshScene() + sphere, "test.pbrt", "."), {});
}

// The first stage of the plan in its place, which notes what scene it sees.
std::mutex seen_mutex;
std::set<const CompiledScene*> seen;
StageFn first_stage;

void NoteScene(Wave& wave) {
  {
    const std::lock_guard<std::mutex> lock(seen_mutex);
    seen.insert(wave.scene);
  }
  first_stage(wave);
}

struct Render {
  FilmAccumulator film;
  RunResult result;
};

Render RenderWith(const CompiledScene& scene, const MemoryNodes* nodes) {
  PlanOptions plan_options;
  plan_options.max_depth = 3;
  Plan plan = MakePlan(scene, plan_options);
  first_stage = plan.stages[0].kernel;
  plan.stages[0].kernel = NoteScene;
  seen.clear();
  Render out{FilmAccumulator(0, 0, scene.film.width, scene.film.height,
                             GroupsOf(scene.strategy), Auxiliary::kNone),
             {}};
  RunOptions options;
  options.spp = 16;
  options.nodes = nodes;
  out.result = Run(scene, plan, options, out.film);
  return out;
}

}  // namespace

TEST_CASE("with several memory nodes tasks read copies, and pixels stay the same",
          "[wavefront][nodes]") {
  const ThreadLimit limit(2);
  const CompiledScene scene = SomeScene();
  const Render usual = RenderWith(scene, nullptr);
  CHECK(usual.result.scene_copies == 0);
  CHECK(seen == std::set<const CompiledScene*>{&scene});
  const MemoryNodes two = TwoNodes();
  const Render copied = RenderWith(scene, &two);
  CHECK(copied.result.scene_copies == 2);
  CHECK(!seen.empty());
  CHECK(seen.count(&scene) == 0);
  CHECK(Identical(usual.film, copied.film));
  const MemoryNodes one({{0, 1}});
  const Render alone = RenderWith(scene, &one);
  CHECK(alone.result.scene_copies == 0);
  CHECK(seen == std::set<const CompiledScene*>{&scene});
  CHECK(Identical(usual.film, alone.film));
}

TEST_CASE("each node reads a copy that shares no array with the scene",
          "[wavefront][nodes]") {
  const CompiledScene scene = SomeScene();
  REQUIRE(scene.accel.nodes.size() > 0);
  const MemoryNodes nodes = TwoNodes();
  const SceneCopies copies(scene, &nodes);
  REQUIRE(copies.count() == 2);
  std::vector<const CompiledScene*> read(2);
  nodes.OnEach([&](int node) { read[static_cast<std::size_t>(node)] = &copies.Here(); });
  for (const CompiledScene* copy : read) {
    REQUIRE(copy != &scene);
    const auto apart = [](const auto& a, const auto& b) {
      CHECK(a.size() == b.size());
      CHECK((a.size() == 0 || a.data() != b.data()));
    };
    apart(copy->accel.nodes, scene.accel.nodes);
    apart(copy->accel.triangle_blocks, scene.accel.triangle_blocks);
    apart(copy->accel.sphere_blocks, scene.accel.sphere_blocks);
    apart(copy->accel.disk_blocks, scene.accel.disk_blocks);
    apart(copy->geometry.triangles, scene.geometry.triangles);
  }
}

}  // namespace lanelight
