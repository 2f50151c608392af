// Passes of a strategy come to what a render does at once.
#include "src/measure/live/pass_renderer.h"

#include <catch2/catch.hpp>

#include "src/base/core/error.h"
#include "src/render/films/accumulator.h"
#include "src/scene/parse/parse.h"
#include "tests/measure/live/live_scene.h"

namespace lanelight::live {
namespace {

class PlainObserver : public PassObserver {
 public:
  bool IsDue() const override { return false; }
  void Observe() override {}
};

// Wants to look all the time.
class QueryingObserver : public PassObserver {
 public:
  bool IsDue() const override { return due_; }
  void Observe() override {
    ++snapshots;
    due_ = snapshots < 20;
  }
  int snapshots = 0;

 private:
  bool due_ = true;
};

Strategy ChangedStrategy(const char* changes) {
  Strategy strategy;
  ApplyStrategy(changes, {}, strategy);
  return strategy;
}

void CheckSameFilms(const FilmAccumulator& a, const FilmAccumulator& b) {
  int different = 0;
  ForEachPixel(a, [&](int x, int y) {
    different += !(a.Mean(x, y) == b.Mean(x, y)) ||
                 !(a.Variance(x, y) == b.Variance(x, y)) ||
                 a.Samples(x, y) != b.Samples(x, y);
  });
  CHECK(different == 0);
}

JobRun WholeRender(const LiveScene& live_scene, const Strategy& strategy,
                   std::uint64_t spp) {
  return RunJob(WithRender(live_scene.job, strategy, spp, live_scene.job.seed));
}

}  // namespace

TEST_CASE("passes are bit-identical to a single render", "[live]") {
  const LiveScene live_scene = SmallLiveScene();
  const std::atomic<bool> never{false};
  for (const char* changes : {"points=sobol", "pairs=antithetic,points=independent",
                              "control=regression", "reuse=block", "roulette=adjoint"}) {
    INFO(changes);
    const Strategy strategy = ChangedStrategy(changes);
    PassRenderer renderer(live_scene, MakeView(live_scene, live_scene.pose, 1), strategy);
    // Another one uses the same scene in between.
    PassRenderer other(live_scene, MakeView(live_scene, live_scene.pose, 2),
                       ChangedStrategy("light-selection=uniform"));
    PlainObserver observer;
    QueryingObserver querying;
    for (const int spp : {2, 4, 10, 16}) {
      renderer.Pass(std::uint64_t(spp),
                    spp == 10 ? static_cast<PassObserver&>(querying) : observer, never);
      other.Pass(std::uint64_t(spp), observer, never);
      CHECK(renderer.spp() == std::uint64_t(spp));
    }
    CHECK(querying.snapshots > 0);
    renderer.Fit();
    CheckSameFilms(renderer.film(), WholeRender(live_scene, strategy, 16).film);
    CHECK(renderer.record().counts.samples == 16u * 32 * 24);
  }
}

TEST_CASE("a stopped pass resumes bit-identically", "[live]") {
  const LiveScene live_scene = SmallLiveScene();
  const Strategy strategy;
  PassRenderer renderer(live_scene, MakeView(live_scene, live_scene.pose, 1), strategy);
  PlainObserver observer;
  const std::atomic<bool> never{false}, at_once{true};
  renderer.Pass(3, observer, never);
  renderer.Pass(8, observer, at_once);
  CHECK(renderer.spp() == 3);
  renderer.Pass(8, observer, never);
  CHECK(renderer.spp() == 8);
  CheckSameFilms(renderer.film(), WholeRender(live_scene, strategy, 8).film);
}

TEST_CASE("a moved camera renders the image of the equivalent scene file", "[live]") {
  const LiveScene live_scene = SmallLiveScene();
  CameraPose pose = live_scene.pose;
  pose.position = pose.position + Vec3d{0.2, 0.1, 0.3};
  pose.fov = 45;
  const View view = MakeView(live_scene, pose, 1);
  PassRenderer renderer(live_scene, view, Strategy{});
  PlainObserver observer;
  const std::atomic<bool> never{false};
  renderer.Pass(4, observer, never);
  SceneDescription scene =
      ParseScene(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt");
  scene.camera = view.described;
  RenderSettings settings;
  settings.resolution = {32, 24};
  settings.spp = 4;
  const Job job = WithRender(PrepareJob(std::move(scene), settings), Strategy{}, 4,
                             live_scene.job.seed);
  CheckSameFilms(renderer.film(), RunJob(job).film);
}

TEST_CASE("a renderer counts stages, rays per cell and errors", "[live]") {
  const LiveScene live_scene = SmallLiveScene();
  PassRenderer renderer(live_scene, MakeView(live_scene, live_scene.pose, 1), Strategy{});
  PlainObserver observer;
  const std::atomic<bool> never{false};
  renderer.Pass(8, observer, never);
  renderer.Pass(9, observer, never);
  renderer.Pass(16, observer, never);
  // 9 is too near to 8 to be worth the time.
  REQUIRE(renderer.snapshots().size() == 2);
  CHECK(renderer.snapshots()[1].spp == 16);
  CHECK(renderer.snapshots()[1].error.relmse.low <=
        renderer.snapshots()[1].error.relmse.value);
  std::uint64_t accumulated = 0;
  for (const StageProfile& stage_profile : renderer.stages()) {
    if (stage_profile.name == "accumulate") accumulated += stage_profile.items;
  }
  CHECK(accumulated == 16u * 32 * 24);
  // Samples, and so rays, of all cells together.
  double rays = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) rays += 16 * renderer.cost().RaysPerSample(x, y);
  }
  const RunCounts& counts = renderer.record().counts;
  CHECK(rays == Approx(double(counts.rays_closest + counts.rays_shadow)));
}

TEST_CASE("a strategy that the scene does not support is refused", "[live]") {
  const LiveScene live_scene = SmallLiveScene();
  CHECK_THROWS_AS(PassRenderer(live_scene, MakeView(live_scene, live_scene.pose, 1),
                               ChangedStrategy("reuse=block,roulette=adjoint")),
                  InputError);
}

}  // namespace lanelight::live
