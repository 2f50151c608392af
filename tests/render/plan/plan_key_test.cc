// Strategies with equal keys render the same bits; what differs has another key.
#include "src/base/core/source_location.h"
#include "src/render/plan/plan_features.h"

#include <catch2/catch.hpp>

#include "src/render/job/job.h"
#include "src/vocabulary/strategy/strategy_text.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

constexpr const char* kBall = R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 6 "integer yresolution" 4 "string filename" "x.exr"
WorldBegin
Material "diffuse" "rgb reflectance" [0.7 0.5 0.3]
Shape "sphere"
LightSource "point" "rgb I" [9 9 9] "point3 from" [0 4 -4]
)";

Strategy Named(const std::string& name) {
  return StrategyNamed(name, {std::make_shared<const std::string>("test"), 0, 0}, {});
}

struct Keyed {
  std::string key;
  std::vector<Rgb> pixels;
};

Keyed Render(const Job& scene, const std::string& strategy) {
  const Job job = WithRender(scene, Named(strategy), 5, scene.seed);
  Keyed out = {PlanKey(job.scene, job.plan), {}};
  FilmAccumulator film = RunJob(job).film;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) out.pixels.push_back(film.Mean(x, y));
  }
  return out;
}

Job Prepare(const TemporaryFolder& folder, const std::string& more,
            std::uint32_t max_depth) {
  RenderSettings settings;
  settings.max_depth = max_depth;
  return PrepareJob(folder.Write("scene.pbrt", kBall + more), settings);
}

}  // namespace

TEST_CASE("choices without effect leave plan and pixels as they are", "[plan]") {
  const TemporaryFolder folder;
  const Job job = Prepare(folder, "", 1);
  const Keyed baseline = Render(job, "default");
  for (const char* same : {"light-selection=uniform", "light-selection=tree",
                           "roulette=none", "c=0.5", "environment=compensated"}) {
    INFO(same);
    const Keyed other = Render(job, same);
    CHECK(other.key == baseline.key);
    CHECK(other.pixels == baseline.pixels);
  }
}

TEST_CASE("choices with an effect change the plan key", "[plan]") {
  const TemporaryFolder folder;
  const Job job =
      Prepare(folder,
              "LightSource \"point\" \"rgb I\" [1 1 1] \"point3 from\" [4 0 -4]\n"
              "LightSource \"infinite\" \"rgb L\" [1 1 1]\n",
              4);
  const std::string baseline = Render(job, "default").key;
  CHECK(Render(job, "default").key == baseline);
  std::vector<std::string> keys = {baseline};
  for (const char* other :
       {"light-selection=uniform", "light-selection=tree", "roulette=none",
        "roulette=throughput:0.2", "roulette=throughput:0:3", "roulette=adjoint",
        "points=halton", "points=independent", "pairs=antithetic",
        "directions=mis:balance", "directions=light", "control=regression",
        "control=regression,c=0.5"}) {
    INFO(other);
    const std::string key = Render(job, other).key;
    CHECK(std::count(keys.begin(), keys.end(), key) == 0);
    keys.push_back(key);
  }
}

}  // namespace lanelight
