// decide=pilot on whole scenes, by pilots of a render of ten seconds.
#include <catch2/catch.hpp>

#include "src/base/core/source_location.h"
#include "src/render/job/job.h"
#include "tests/support/shared_scenes.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kPlanned = 4'000'000;
constexpr int kSeeds = 8;

struct Choices {
  int adjoint = 0, blocks = 0, splats = 0;
};

// In how many of kSeeds renders each is chosen.
Choices ChoicesFor(const std::string& scene) {
  RenderSettings settings;
  settings.spp = 1;
  Strategy strategy;
  ApplyStrategy("decide=pilot", {}, strategy);
  const Job job = WithStrategy(PrepareJob(scene, settings), strategy);
  Choices chosen;
  for (int seed = 0; seed < kSeeds; ++seed) {
    FilmAccumulator film = MakeFilm(job);
    RunOptions options;
    options.spp = 1;
    options.seed = static_cast<std::uint64_t>(seed);
    options.planned_samples = kPlanned;
    const RunResult result = Run(job.scene, job.plan, options, film);
    UNSCOPED_INFO(seed << ": " << result.training.note);
    chosen.adjoint += result.training.changes == "roulette=adjoint,decide=none";
    chosen.blocks += result.training.changes.find("reuse=block") != std::string::npos;
    chosen.splats += result.training.changes.find("splats") != std::string::npos;
  }
  return chosen;
}

}  // namespace

TEST_CASE("a trial run accounts for rare bright samples", "[decision]") {
  if (!HaveSharedScenes()) return;
  const std::string folder = SharedScenes().string();
  // Few bright samples carry the error behind the door; adjoint is 2.7 times as
  // efficient, blocks 4.6 times. Of 8 other seeds one or the other was chosen by 8.
  const Choices ajar = ChoicesFor(folder + "/veach-ajar/reference.pbrt");
  CHECK(ajar.adjoint + ajar.blocks >= 5);
  CHECK(ajar.blocks >= 3);
  // Where adjoint loses a quarter, by no more than one (of 16 other seeds by none: by two
  // of 8 with a probability below 0.03 at one in 33); blocks are 7 times as efficient.
  const Choices box = ChoicesFor(folder + "/cornell-box/reference.pbrt");
  CHECK(box.adjoint <= 1);
  CHECK(box.blocks >= 6);
  CHECK(box.splats == 0);  // which gain nothing there
  // Hardly any path meets a second surface that serves others.
  CHECK(ChoicesFor(folder + "/coffee/reference.pbrt").blocks == 0);
}

TEST_CASE("a trial run finds caustics that camera paths miss",
          "[decision][light_paths]") {
  CHECK(ChoicesFor(LANELIGHT_SOURCE_DIR "/scenes/caustic.pbrt").splats == kSeeds);
}

}  // namespace lanelight
