// Passes of a strategy come to what a render does at once.
#include "src/measure/live/contender.h"

#include <catch2/catch.hpp>

#include "src/base/core/error.h"
#include "src/render/films/for_each_pixel.h"
#include "src/scene/parse/parse.h"
#include "tests/measure/live/live_scene.h"

namespace lanelight::live {
namespace {

class NoAttendant : public Attendant {
 public:
  bool Due() const override { return false; }
  void Attend() override {}
};

// Wants to look all the time.
class CuriousAttendant : public Attendant {
 public:
  bool Due() const override { return due_; }
  void Attend() override {
    ++looks;
    due_ = looks < 20;
  }
  int looks = 0;

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

JobRun WholeRender(const Stage& stage, const Strategy& strategy, std::uint64_t spp) {
  return RunJob(WithRender(stage.job, strategy, spp, stage.job.seed));
}

}  // namespace

TEST_CASE("passes have the bits of a render at once", "[live]") {
  const Stage stage = SmallStage();
  const std::atomic<bool> never{false};
  for (const char* changes :
       {"points=sobol", "pairs=antithetic,points=independent", "control=regression",
        "reuse=block", "roulette=efficiency"}) {
    INFO(changes);
    const Strategy strategy = ChangedStrategy(changes);
    Contender contender(stage, MakeView(stage, stage.eye, 1), strategy);
    // Another one uses the same scene in between.
    Contender other(stage, MakeView(stage, stage.eye, 2),
                    ChangedStrategy("light-selection=uniform"));
    NoAttendant attendant;
    CuriousAttendant curious;
    for (const int spp : {2, 4, 10, 16}) {
      contender.Pass(std::uint64_t(spp),
                     spp == 10 ? static_cast<Attendant&>(curious) : attendant, never);
      other.Pass(std::uint64_t(spp), attendant, never);
      CHECK(contender.spp() == std::uint64_t(spp));
    }
    CHECK(curious.looks > 0);
    contender.Fit();
    CheckSameFilms(contender.film(), WholeRender(stage, strategy, 16).film);
    CHECK(contender.record().counts.samples == 16u * 32 * 24);
  }
}

TEST_CASE("a pass that was stopped goes on as if it had not been", "[live]") {
  const Stage stage = SmallStage();
  const Strategy strategy;
  Contender contender(stage, MakeView(stage, stage.eye, 1), strategy);
  NoAttendant attendant;
  const std::atomic<bool> never{false}, at_once{true};
  contender.Pass(3, attendant, never);
  contender.Pass(8, attendant, at_once);
  CHECK(contender.spp() == 3);
  contender.Pass(8, attendant, never);
  CHECK(contender.spp() == 8);
  CheckSameFilms(contender.film(), WholeRender(stage, strategy, 8).film);
}

TEST_CASE("a moved camera sees what its scene file would show", "[live]") {
  const Stage stage = SmallStage();
  Eye eye = stage.eye;
  eye.position = eye.position + Vec3d{0.2, 0.1, 0.3};
  eye.fov = 45;
  const View view = MakeView(stage, eye, 1);
  Contender contender(stage, view, Strategy{});
  NoAttendant attendant;
  const std::atomic<bool> never{false};
  contender.Pass(4, attendant, never);
  SceneDescription scene =
      ParseScene(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt");
  scene.camera = view.described;
  RenderSettings settings;
  settings.resolution = {32, 24};
  settings.spp = 4;
  const Job job =
      WithRender(PrepareJob(std::move(scene), settings), Strategy{}, 4, stage.job.seed);
  CheckSameFilms(contender.film(), RunJob(job).film);
}

TEST_CASE("a contender counts stages, rays by places, and its errors", "[live]") {
  const Stage stage = SmallStage();
  Contender contender(stage, MakeView(stage, stage.eye, 1), Strategy{});
  NoAttendant attendant;
  const std::atomic<bool> never{false};
  contender.Pass(8, attendant, never);
  contender.Pass(9, attendant, never);
  contender.Pass(16, attendant, never);
  // 9 is too near to 8 to be worth the time.
  REQUIRE(contender.looks().size() == 2);
  CHECK(contender.looks()[1].spp == 16);
  CHECK(contender.looks()[1].error.relmse.low <= contender.looks()[1].error.relmse.value);
  std::uint64_t accumulated = 0;
  for (const StageProfile& stage_profile : contender.stages()) {
    if (stage_profile.name == "accumulate") accumulated += stage_profile.items;
  }
  CHECK(accumulated == 16u * 32 * 24);
  // Samples, and so rays, of all cells together.
  double rays = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) rays += 16 * contender.cost().RaysPerSample(x, y);
  }
  const RunCounts& counts = contender.record().counts;
  CHECK(rays == Approx(double(counts.rays_closest + counts.rays_shadow)));
}

TEST_CASE("a strategy that the scene does not take is refused", "[live]") {
  const Stage stage = SmallStage();
  CHECK_THROWS_AS(Contender(stage, MakeView(stage, stage.eye, 1),
                            ChangedStrategy("reuse=block,roulette=adjoint")),
                  InputError);
}

}  // namespace lanelight::live
