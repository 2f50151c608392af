#include "src/measure/stress/scene_point.h"

#include <cmath>
#include <limits>

#include "src/scene/parse/parse.h"

namespace lanelight::stress {

Job PrepareText(const SceneText& scene) {
  ParseOptions parse;
  parse.allow_files = false;
  RenderSettings settings = scene.settings;
  settings.copied_triangles = 0;  // instances are to be stressed, not their copies
  return PrepareJob(ParseSceneText(scene.text, "scene", ".", parse), settings);
}

JobRun RenderText(const SceneText& scene) { return RunJob(PrepareText(scene)); }

Point MeanOf(const JobRun& rendered) {
  const FilmAccumulator& film = rendered.film;
  Point point;
  double sum = 0, variance = 0, quartic = 0, deviations = 0;
  bool has_variance = true;
  for (int y = film.y0(); y < film.y0() + film.height(); ++y) {
    for (int x = film.x0(); x < film.x0() + film.width(); ++x) {
      const Rgb mean = film.Mean(x, y), own = film.Variance(x, y);
      sum += (mean.x + mean.y + mean.z) / 3;
      // Channels of one pixel depend on each other: their standard deviations add.
      const double deviation =
          (std::sqrt(own.x) + std::sqrt(own.y) + std::sqrt(own.z)) / 3;
      const double square = deviation * deviation;
      variance += square;
      deviations += deviation;
      // Welch and Satterthwaite: degrees of freedom of a sum of estimated variances.
      const std::uint64_t observations = film.Observations(x, y);
      has_variance &= observations >= 2;
      if (observations >= 2) quartic += square * square / double(observations - 1);
    }
  }
  const double pixels = double(film.width()) * film.height();
  point.measured = sum / pixels;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  // Errors of pixels that paths serve together may be one and the same.
  const bool served = film.groups().dependents > 1;
  const double error = served ? deviations : std::sqrt(variance);
  point.standard_error = has_variance ? error / pixels : kNan;
  if (quartic > 0) point.degrees_of_freedom = variance * variance / quartic;
  const RunResult& result = rendered.result;
  point.samples = result.samples;
  point.rays = result.rays_closest + result.rays_shadow;
  point.invalid = result.health.nan + result.health.infinite + result.health.negative;
  point.seconds = result.cpu_seconds;
  for (const StageProfile& stage : result.stages) {
    point.lanes_used += stage.items;
    point.lane_slots += stage.lane_slots;
  }
  return point;
}

}  // namespace lanelight::stress
