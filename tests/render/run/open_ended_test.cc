// Renders without a fixed number of samples: they end for the reason they say, treat all
// pixels alike, do not depend on the number of threads, and are unbiased.
#include <catch2/catch.hpp>
#include <atomic>
#include <cmath>

#include "src/render/estimate/estimate.h"
#include "src/render/schedule/schedule.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/render/run/lamp_scene.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight {
namespace {

struct OpenEnded {
  std::string strategy = "points=sobol";
  double target = 0, seconds = 0;
  std::uint64_t spp = 0, seed = 1;
  int threads = 2;
  std::uint32_t wavefront = 0;
  const std::atomic<bool>* stop = nullptr;
};

Rendered Render(const OpenEnded& o) {
  const ThreadLimit limit(o.threads);
  PreparedScene scene =
      PrepareScene(ParseSceneText(LampScene(37, 29, 3), "test.pbrt", "."), {});
  Strategy strategy = scene.strategy;
  ApplyStrategy(o.strategy, {}, strategy);
  scene = WithStrategy(scene, strategy);
  PlanOptions plan_options;
  plan_options.max_depth =
      static_cast<std::uint32_t>(scene.compiled->integrator.max_depth);
  plan_options.wavefront = o.wavefront;
  const Plan plan = MakePlan(scene, plan_options);
  Rendered out{FilmAccumulator(0, 0, 37, 29, GroupsOf(scene.strategy), Auxiliary::kNone),
               {},
               plan};
  RunOptions options;
  options.spp = o.spp;
  options.seed = o.seed;
  options.seconds = o.seconds;
  options.stop = o.stop;
  if (o.target > 0) {
    options.samples_needed = [&](const FilmAccumulator& film, std::uint64_t done) {
      CHECK(&film == &out.film);
      CHECK(film.Samples(0, 0) == done);
      CHECK(film.Samples(36, 28) == done);
      return SamplesNeeded({o.target, 0}, EstimateError(film), done);
    };
  }
  out.result = Run(scene, plan, options, out.film);
  return out;
}

}  // namespace

TEST_CASE("a render stops once its error is below the target", "[open_ended]") {
  for (const char* strategy :
       {"points=independent", "points=sobol", "points=stratified,pairs=antithetic",
        "points=halton,control=regression", "points=sobol,control=regression"}) {
    INFO(strategy);
    OpenEnded o;
    o.strategy = strategy;
    o.target = 0.0004;
    const Rendered r = Render(o);
    CHECK(r.result.stop_reason == StopReason::kTarget);
    CHECK_FALSE(r.result.stopped_early);
    const ErrorEstimate e = EstimateError(r.film);
    CHECK(Reached({o.target, 0}, e));
    CHECK(e.relmse.value > o.target / 2);  // not by much
    CHECK(r.result.num_checks >= 2);
    CHECK(r.result.num_checks <= 24);  // up to 512 units
    CHECK(r.result.samples % (37 * 29) == 0);
    const std::uint64_t done = r.film.Samples(3, 3);
    CHECK(CheckFrom(done, r.film.groups().unit) == done);
    CHECK(r.film.Observations(3, 3) >= 4);
  }
}

TEST_CASE("where a render stops does not depend on threads and wavefronts",
          "[open_ended]") {
  for (const char* strategy : {"points=sobol", "points=independent,control=regression"}) {
    OpenEnded o;
    o.strategy = strategy;
    o.target = 0.01;
    const Rendered reference = Render(o);
    o.threads = 1;
    o.wavefront = 100;
    const Rendered other = Render(o);
    CHECK(other.result.samples == reference.result.samples);
    CHECK(Identical(other.film, reference.film));
    o.seed = 2;
    CHECK_FALSE(Identical(Render(o).film, reference.film));
  }
}

TEST_CASE("a sample limit or a stop ends a render with a target", "[open_ended]") {
  OpenEnded o;
  o.target = 1e-9;
  o.spp = 40;
  const Rendered limited = Render(o);
  CHECK(limited.result.stop_reason == StopReason::kSamples);
  CHECK(limited.result.samples == 40 * 37 * 29);
  CHECK(limited.film.Observations(0, 0) >= 4);
  const std::atomic<bool> stop{true};
  o.stop = &stop;
  const Rendered stopped = Render(o);
  CHECK(stopped.result.stop_reason == StopReason::kInterrupted);
  CHECK(stopped.result.stopped_early);
  o.stop = nullptr;
  for (std::uint64_t spp : {1, 2, 3, 5}) {  // fewer than the first look takes
    o.spp = spp;
    CHECK(Render(o).result.samples == spp * 37 * 29);
  }
}

TEST_CASE("a time budget gives every pixel a sample and ends", "[open_ended]") {
  for (const char* strategy : {"points=sobol", "points=stratified,pairs=antithetic",
                               "points=sobol,control=regression"}) {
    for (double seconds : {1e-6, 0.2}) {
      OpenEnded o;
      o.strategy = strategy;
      o.seconds = seconds;
      const Rendered r = Render(o);
      CHECK(r.result.stop_reason == StopReason::kTime);
      for (int y = 0; y < 29; ++y) {
        for (int x = 0; x < 37; ++x) REQUIRE(r.film.Samples(x, y) > 0);
      }
    }
  }
  OpenEnded both;
  both.seconds = 0.05;
  both.target = 1e-9;
  CHECK(Render(both).result.stop_reason == StopReason::kTime);
  both.seconds = 1000;
  both.target = 0.05;
  CHECK(Render(both).result.stop_reason == StopReason::kTarget);
}

TEST_CASE("a render stopped at any time has variances", "[open_ended]") {
  for (int i = 0; i < kNumSampleSequences; ++i) {
    const std::string points = Name(static_cast<SampleSequence>(i));
    for (const char* pairs : {"", ",pairs=antithetic"}) {
      CAPTURE(points, pairs);
      const ThreadLimit limit(2);
      PreparedScene scene =
          PrepareScene(ParseSceneText(LampScene(37, 29, 3), "test.pbrt", "."), {});
      Strategy strategy = scene.strategy;
      ApplyStrategy("points=" + points + pairs, {}, strategy);
      scene = WithStrategy(scene, strategy);
      PlanOptions plan_options;
      plan_options.max_depth = 3;
      const Plan plan = MakePlan(scene, plan_options);
      FilmAccumulator film(0, 0, 37, 29, GroupsOf(scene.strategy), Auxiliary::kNone);
      std::atomic<bool> stop{false};
      RunOptions options;
      options.spp = 1'000'000;
      options.stop = &stop;
      // After the short first passes, and a few tasks of the million that is planned.
      options.on_progress = [&](const Progress& p) {
        if (p.samples > 32 * 37 * 29) stop = true;
      };
      const RunResult result = Run(scene, plan, options, film);
      CHECK(result.stop_reason == StopReason::kInterrupted);
      int sampled = 0, varied = 0;
      for (int y = 0; y < 29; ++y) {
        for (int x = 0; x < 37; ++x) {
          if (film.Samples(x, y) == 0) continue;
          ++sampled;
          REQUIRE(film.Samples(x, y) < 10000);
          REQUIRE(film.HasVariance(x, y));
          const Rgb v = film.Variance(x, y);
          REQUIRE(std::isfinite(v.x + v.y + v.z));
          varied += v.x > 0;
        }
      }
      CHECK(sampled > 0);
      CHECK(2 * varied > sampled);
    }
  }
}

TEST_CASE("stopping at the target keeps the image unbiased", "[open_ended]") {
  TestRender t;
  t.sampler = SampleSequence::kSobol;
  t.spp = 8192;
  t.seed = 99;
  const Rendered truth = RenderText(LampScene(37, 29, 3), t);
  const Rgb mean = ImageMean(truth.film), error = ImageStandardError(truth.film);
  for (const char* strategy : {"points=sobol", "points=stratified", "points=halton"}) {
    Rgb sum, square;
    constexpr int kRenders = 16;
    for (int i = 0; i < kRenders; ++i) {
      OpenEnded o;
      o.strategy = strategy;
      o.target = 0.002;
      o.seed = static_cast<std::uint64_t>(i + 1);
      const Rendered r = Render(o);
      const Rgb own = ImageStandardError(r.film);
      sum += ImageMean(r.film) / kRenders;
      for (int c = 0; c < 3; ++c) square[c] += own[c] * own[c] / kRenders / kRenders;
    }
    for (int c = 0; c < 3; ++c) {
      // 6 deviations: a false alarm in 10^8. One of 1 % would be seen.
      const double sigma = std::sqrt(square[c] + error[c] * error[c]);
      CHECK(std::abs(sum[c] - mean[c]) < 6 * sigma);
      CHECK(6 * sigma < 0.01 * mean[c]);
    }
  }
}

}  // namespace lanelight
