// Where lamps are found by chance alone, what no sample has met is in no estimate: no
// interval is printed where it may be missing.
#include "src/base/core/source_location.h"
#include "src/scene/prepare/prepared_scene.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/pi.h"
#include "src/render/estimate/estimate.h"
#include "src/render/job/job.h"

namespace lanelight {
namespace {

Job JobWith(const std::string& scene, const std::string& strategy) {
  RenderSettings settings;
  settings.spp = 16;
  settings.resolution = {48, 48};
  settings.strategy = ParseStrategy(strategy, {});
  return PrepareJob(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/" + scene, settings);
}

ErrorEstimate ErrorOf(const std::string& scene, const std::string& strategy) {
  const Job job = JobWith(scene, strategy);
  FilmAccumulator film = RunJob(job).film;
  return EstimateError(film);
}

}  // namespace

TEST_CASE("a sun that is rarely sampled gives errors without an interval", "[estimate]") {
  for (const char* strategy : {"directions=bsdf", "directions=uniform"}) {
    INFO(strategy);
    const ErrorEstimate blinds = ErrorOf("blinds.pbrt", strategy);
    CHECK_FALSE(blinds.has_interval);
    CHECK_THAT(blinds.why, Catch::Contains("hit lamps by chance"));
    CHECK(ErrorOf("cornell-box.pbrt", strategy).has_interval);
  }
  CHECK(ErrorOf("blinds.pbrt", "directions=mis").why.find("chance") == std::string::npos);
}

TEST_CASE("dependent pixels lower the degrees of freedom", "[estimate]") {
  const auto pixel = [](int x, int y) {
    const double v = 1 + 0.1 * ((x * 7 + y * 3) % 5);
    return PixelEstimate{true, {1, 1, 1}, {v, v, v}, 3};
  };
  const PixelRect window = {0, 0, 64, 64};
  const ErrorEstimate alone = EstimateError(window, pixel);
  const ErrorEstimate shared = EstimateError(window, pixel, 16);
  CHECK(shared.relmse.value == Approx(alone.relmse.value));
  CHECK(shared.effective_pixels == Approx(alone.effective_pixels / 16).epsilon(0.01));
  // Standard errors of a variance grow as the square root.
  const auto width = [](const Interval& v) { return std::log(v.high / v.low); };
  CHECK(width(shared.rmse) == Approx(4 * width(alone.rmse)).epsilon(0.1));
}

TEST_CASE("the probability of hitting a light is its fraction of directions",
          "[estimate]") {
  CHECK(ChanceOfLight(JobWith("blinds.pbrt", "directions=mis").scene) == 1);
  CHECK(ChanceOfLight(JobWith("furnace.pbrt", "directions=bsdf").scene) == 1);
  // A disk of 0.27 degrees, straight on, whose light is nearly all there is.
  const double sun = 6.8e-5 / (4 * kPi);
  const double chance = ChanceOfLight(JobWith("blinds.pbrt", "directions=bsdf").scene);
  CHECK(chance > sun / 4);
  CHECK(chance < sun * 2);
}

}  // namespace lanelight
