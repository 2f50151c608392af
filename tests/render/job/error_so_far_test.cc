// A running render knows its error so far.
#include "src/render/job/error_so_far.h"

#include <catch2/catch.hpp>
#include <vector>

#include "src/render/job/job.h"

namespace lanelight {
namespace {

Job SmallBox(const RenderSettings& render_settings) {
  RenderSettings settings = render_settings;
  settings.resolution = {16, 12};
  return PrepareJob(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt",
                    settings);
}

}  // namespace

TEST_CASE("showing the film does not change the image", "[render]") {
  RenderSettings settings;
  settings.spp = 20000;
  const Job job = SmallBox(settings);
  RunOptions options = RunOptionsOf(job);
  FilmAccumulator plain = MakeFilm(job), shown = MakeFilm(job);
  Run(job.scene, job.plan, options, plain);
  ErrorSoFar error({});
  error.Listen(job.window.pixels(), options);
  REQUIRE(options.on_film);
  int shows = 0;
  const auto estimate = options.on_film;
  options.on_film = [&](const FilmAccumulator& film) {
    ++shows;
    estimate(film);
  };
  CHECK_FALSE(error.At({}).error);
  Run(job.scene, job.plan, options, shown);
  REQUIRE(shows > 0);
  const RenderProgress progress = error.At({0.5, 1, 100});
  REQUIRE(progress.error);
  CHECK(progress.error->available);
  CHECK_FALSE(progress.target_seconds);
  // With more samples than the estimate had, less is left.
  const std::uint64_t all = 20000 * job.window.pixels();
  const double at_end = error.At({1, 1, all}).error->relmse.value;
  CHECK(error.At({1, 1, 4 * all}).error->relmse.value == Approx(at_end / 4));
  for (int y = 0; y < plain.height(); ++y) {
    for (int x = 0; x < plain.width(); ++x) {
      for (int c = 0; c < 3; ++c) REQUIRE(plain.Mean(x, y)[c] == shown.Mean(x, y)[c]);
    }
  }
}

TEST_CASE("with a target, progress shows the error and the remaining samples",
          "[render]") {
  RenderSettings settings;
  settings.target_relmse = 1e-4;
  const Job job = SmallBox(settings);
  RunOptions options = RunOptionsOf(job);
  ErrorSoFar error(job.target);
  error.Listen(job.window.pixels(), options);
  CHECK_FALSE(options.on_film);
  std::vector<RenderProgress> reports;
  const auto look = options.samples_needed;
  options.samples_needed = [&](const FilmAccumulator& film, std::uint64_t done) {
    const double needed = look(film, done);
    reports.push_back(error.At({0, 2, done * job.window.pixels()}));
    if (reports.back().target_seconds) {
      CHECK(*reports.back().target_seconds ==
            Approx(std::max(0.0, 2 * (needed / double(done) - 1))));
    }
    return needed;
  };
  FilmAccumulator film = MakeFilm(job);
  const RunResult result = Run(job.scene, job.plan, options, film);
  CHECK(result.stop_reason == StopReason::kTarget);
  REQUIRE(!reports.empty());
  REQUIRE(reports.back().error);
  CHECK(reports.back().error->relmse.high < 1e-4);
  CHECK(reports.back().target_seconds == 0.0);
}

}  // namespace lanelight
