// Jobs of one scene: what they share, that they leave each other alone, and what another
// strategy takes of memory.
#include <catch2/catch.hpp>

#include <thread>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/base/core/source_location.h"
#include "src/render/films/accumulator.h"
#include "src/render/job/job.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/scene.h"
#include "tests/render/wave/interposed.h"

namespace lanelight {
namespace {

Job SceneJob(const char* name, int width = 32, int height = 24) {
  RenderSettings settings;
  settings.resolution = {width, height};
  settings.spp = 16;
  settings.decision = DefaultDecision::kNever;
  return PrepareJob(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/" + name, settings);
}

Job With(const Job& job, const char* changes) {
  Strategy strategy = job.scene.strategy;
  ApplyStrategy(changes, {}, strategy);
  return WithStrategy(job, strategy);
}

std::vector<Rgb> PixelsOf(const Job& job) {
  const FilmAccumulator film = RunJob(job).film;
  std::vector<Rgb> pixels;
  ForEachPixel(film, [&](int x, int y) {
    pixels.push_back(film.Mean(x, y));
    pixels.push_back(film.Variance(x, y));
  });
  return pixels;
}

std::size_t BytesOf(const LightChances& chances) {
  const auto bytes = [](const auto&... arrays) {
    return (... + (arrays.size() * sizeof(arrays[0])));
  };
  const LightTree& tree = chances.tree;
  return bytes(chances.pmf, chances.alias_q, chances.alias, tree.nodes,
               tree.primitive_leaf, tree.far, chances.anchors, chances.anchor_alias);
}

}  // namespace

// Each pair differs in what used to be written into the scene: which light is selected,
// by a table or a tree; texels of a sky; places that points in media are looked for at.
TEST_CASE("concurrent jobs of a scene give the images of sequential ones", "[render]") {
  struct Pair {
    const char *scene, *one, *other;
  };
  for (const Pair& pair :
       {Pair{"many-lights.pbrt", "light-selection=tree", "light-selection=uniform"},
        Pair{"sun-sky.pbrt", "environment=compensated", "directions=bsdf"},
        Pair{"media.pbrt", "distances=equiangular", "roulette=adjoint"}}) {
    INFO(pair.scene);
    const Job scene = SceneJob(pair.scene);
    const Job one = With(scene, pair.one), other = With(scene, pair.other);
    const std::vector<Rgb> alone = PixelsOf(one), other_alone = PixelsOf(other);
    CHECK(alone != other_alone);
    std::vector<Rgb> together, other_together;
    std::thread beside([&] { other_together = PixelsOf(With(scene, pair.other)); });
    together = PixelsOf(one);
    beside.join();
    CHECK(together == alone);
    CHECK(other_together == other_alone);
  }
}

TEST_CASE("deriving jobs does not change a job", "[render]") {
  const Job job = SceneJob("many-lights.pbrt");
  const AlignedVector<float> pmf = job.scene.chances->pmf;
  const Job other = With(job, "light-selection=tree");
  CHECK(job.scene.chances->pmf == pmf);
  CHECK(job.scene.chances->tree.nodes.empty());
  CHECK(job.scene.strategy.light_selection == LightSelection::kPower);
  CHECK_FALSE(other.scene.chances->tree.nodes.empty());
  CHECK(other.scene.compiled == job.scene.compiled);
  CHECK(other.loaded == job.loaded);
  const Job more = WithRender(job, job.scene.strategy, 99, 7);
  CHECK(more.spp == 99);
  CHECK(more.seed == 7);
  CHECK(job.spp == 16);
  CHECK_THROWS_AS(With(job, "reuse=block,roulette=adjoint"), InputError);
}

// What is allocated on the way, for the strategy's tables and for the plan, which does
// not grow with the scene.
TEST_CASE("another strategy on a scene adds only the memory of its tables", "[render]") {
  if (!CanInterpose()) return;
  constexpr std::size_t kPlan = 150'000;
  for (const char* name :
       {"cornell-box.pbrt", "motion.pbrt", "hair.pbrt", "many-lights.pbrt"}) {
    const Job job = SceneJob(name);
    const ThreadLimit one(1);
    for (const char* changes : {"light-selection=tree", "environment=compensated"}) {
      INFO(name << ", " << changes);
      const CountCalls count;
      const Job other = With(job, changes);
      const std::uint64_t bytes = count.calls().bytes;
      CAPTURE(bytes, BytesOf(*other.scene.chances), job.scene.compiled->accel.Bytes());
      CHECK(bytes < kPlan + 4 * BytesOf(*other.scene.chances));
    }
  }
}

}  // namespace lanelight
