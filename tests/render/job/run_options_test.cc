// How a job is run, for any film and as often as one likes.
#include <catch2/catch.hpp>

#include "src/render/job/job.h"

namespace lanelight {

TEST_CASE("each render with a target checks its own film", "[render]") {
  RenderSettings settings;
  settings.resolution = {16, 12};
  settings.spp = 1u << 12;
  settings.target_relmse = 0.05;
  const Job job = PrepareJob(
      std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt", settings);
  const RunOptions options = RunOptionsOf(job);
  std::uint64_t samples = 0;
  for (int i = 0; i < 2; ++i) {
    FilmAccumulator film = MakeFilm(job);
    const RunResult result = Run(job.scene, job.plan, options, film);
    CHECK(result.stop_reason == StopReason::kTarget);
    CHECK(result.samples < job.spp * job.window.pixels());
    if (i > 0) CHECK(result.samples == samples);
    samples = result.samples;
  }
}

}  // namespace lanelight
