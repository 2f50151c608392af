// Windows of an image: cover it, are rendered like the whole, and their errors are its.
#include "src/advise/window_errors.h"

#include <catch2/catch.hpp>
#include <set>

#include "src/prepare/groups.h"
#include "src/prepare/use_strategy.h"
#include "src/advise/candidates.h"
#include "src/estimate/estimate.h"

namespace lanelight {
namespace {

Job SmallBox() {
  RenderSettings settings;
  settings.resolution = {64, 48};
  settings.seconds = 1;
  return PrepareJob(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt",
                    settings);
}

// The whole image with the seed of a pilot's first round.
FilmAccumulator Whole(Job& job) {
  job.spp = 128;
  job.seconds = 0;
  job.seed += 1;
  FilmAccumulator film = MakeFilm(job);
  RunJob(job, film);
  return film;
}

}  // namespace

TEST_CASE("windows cover the image evenly", "[study]") {
  WindowSequence sequence({16, 8, 16 + 64, 8 + 48});
  std::set<std::pair<int, int>> cells;
  for (const PixelRect& w : sequence.Next(24)) {
    CHECK((w.width() == 8 && w.height() == 8));
    CHECK((w.x0 >= 16 && w.y0 >= 8 && w.x1 <= 80 && w.y1 <= 56));
    CHECK((w.x0 % 8 == 0 && w.y0 % 8 == 0));
    cells.insert({(w.x0 - 16) / 16, (w.y0 - 8) / 16});
  }
  CHECK(cells.size() == 12);  // every cell of twice the side
  WindowSequence narrow({0, 0, 5, 300});
  for (const PixelRect& w : narrow.Next(10)) CHECK((w.width() == 5 && w.height() == 5));
}

TEST_CASE("windows have the samples that the whole image has there", "[study]") {
  Job job = SmallBox();
  const std::vector<PixelRect> windows = {{8, 16, 16, 24}, {56, 40, 64, 48}};
  FilmAccumulator strip(0, 0, 16, 8, GroupsOf(job.scene.strategy), Auxiliary::kNone);
  RunOptions options;
  options.spp = 128;
  options.seed = job.seed + 1;
  options.windows = windows;
  Run(job.scene, job.plan, options, strip);
  const FilmAccumulator whole = Whole(job);
  for (int i = 0; i < 2; ++i) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const PixelRect& w = windows[static_cast<std::size_t>(i)];
        const Rgb a = strip.Mean(8 * i + x, y), b = whole.Mean(w.x0 + x, w.y0 + y);
        CHECK(a.x == Approx(b.x).epsilon(1e-6));
        CHECK(a.z == Approx(b.z).epsilon(1e-6));
        CHECK(strip.Samples(8 * i + x, y) == 128);
      }
    }
  }
}

TEST_CASE("errors of windows average to the error of the image", "[study]") {
  Job job = SmallBox();
  WindowRenderer renderer(job, {job.scene.strategy}, nullptr);
  double elapsed = 0, mean = 0, robust = 0;
  const auto measured = renderer({0}, 48, elapsed);
  REQUIRE(measured.size() == 1);
  REQUIRE(measured[0].all.size() == 48);
  for (double e : measured[0].all) mean += e / 48;
  for (double e : measured[0].robust) robust += e / 48;
  CHECK(elapsed > 0);
  REQUIRE(measured[0].seconds.size() == 48);
  REQUIRE(measured[0].batch.size() == 48);
  CHECK(measured[0].batch.back() == 7);
  CHECK(std::is_sorted(measured[0].batch.begin(), measured[0].batch.end()));
  for (std::size_t i = 1; i < 48; ++i) {
    const auto& m = measured[0];
    if (m.batch[i] == m.batch[i - 1]) CHECK(m.seconds[i] == m.seconds[i - 1]);
  }
  CHECK(measured[0].seconds.front() >= 0);
  CHECK(robust < mean);
  CHECK(robust > 0.3 * mean);
  // Some windows twice, some never: near the estimate of the whole, not on it.
  const ErrorEstimate whole = EstimateError(Whole(job));
  CHECK(mean == Approx(whole.relmse.value).epsilon(0.25));
}

TEST_CASE("candidates that a scene refuses say why", "[study]") {
  Job job = SmallBox();
  const Strategy own = Changed(job.scene.strategy, "points=halton");
  UseStrategy(own, job.scene);
  const auto candidates = CandidatesFor(job.scene, job.plan.options);
  CHECK(job.scene.strategy == own);
  CHECK(candidates[0].strategy == Strategy());
  CHECK(candidates[0].changes.empty());
  CHECK(candidates[3].strategy == own);
  CHECK(Changed({}, candidates[3].changes) == own);
  int refused = 0;
  for (const Candidate& c : candidates) {
    refused += !c.refused.empty();
    if (c.changes == "control=ambient") CHECK(c.refused.find("environment") < 60);
    CHECK_FALSE(c.meaning.empty());
  }
  CHECK(refused == 2);  // of environments, and of many lights
}

TEST_CASE("candidates that do the same on a scene are not compared", "[study]") {
  RenderSettings settings;
  settings.resolution = {16, 12};
  settings.max_depth = 1;  // no roulette is played
  settings.seconds = 1;
  Job job =
      PrepareJob(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/paper.pbrt", settings);
  int same = 0;
  for (const Candidate& c : CandidatesFor(job.scene, job.plan.options)) {
    const bool roulette =
        c.changes == "roulette=none" || c.changes == "roulette=luminance";
    const bool refused = c.refused.find("exactly what the default") != std::string::npos;
    if (roulette) CHECK(refused);
    same += refused;
  }
  CHECK(same >= 2);
}

}  // namespace lanelight
