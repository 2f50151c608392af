// Renders with allocation=error: the same bits however they are cut, whole images where
// there is nothing to share out, and no bias.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/wavefront/allocation.h"
#include "tests/wavefront/render_fixture.h"

namespace lanelight {
namespace {

// A lamp whose half shadow is noisy, and a floor that is lit evenly.
std::string Scene(int width, int height, double light = 1) {
  return fmt::format(R"(
LookAt 0 2 -6  0 0.6 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" {} "integer yresolution" {}
Integrator "path" "integer maxdepth" 3
WorldBegin
LightSource "point" "point3 from" [ -3 4 -2 ] "rgb I" [ {} {} {} ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ {} {} {} ]
  Translate 2 3 0
  Shape "sphere" "float radius" 0.5
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.4 ]
AttributeBegin
  Rotate -90 1 0 0
  Shape "plane"
AttributeEnd
Translate 0.8 0.8 0
Shape "sphere" "float radius" 0.6
)",
                     width, height, 9 * light, 9 * light, 9 * light, 8 * light, 8 * light,
                     8 * light);
}

Rendered RenderWith(const std::string& text, const std::string& strategy,
                    std::uint64_t spp, std::uint64_t seed = 1, int threads = 2,
                    std::uint32_t wavefront = 0) {
  TestRender t;
  t.spp = spp;
  t.seed = seed;
  t.threads = threads;
  t.wavefront = wavefront;
  t.sampler = Points::kSobol;
  t.strategy = strategy;
  return RenderText(text, t);
}

struct Counts {
  std::uint64_t least = ~std::uint64_t{0}, most = 0, all = 0;
};
Counts CountsOf(const FilmAccumulator& film) {
  Counts out;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const std::uint64_t samples = film.Samples(x, y);
      out.least = std::min(out.least, samples);
      out.most = std::max(out.most, samples);
      out.all += samples;
    }
  }
  return out;
}

}  // namespace

TEST_CASE("shared-out samples: the same bits for any threads and wavefront size",
          "[allocation]") {
  for (const char* strategy :
       {"allocation=error", "allocation=error,points=independent,pairs=antithetic"}) {
    const std::string text = Scene(70, 37);
    const Rendered reference = RenderWith(text, strategy, 50, 1, 1, 1000);
    const Counts counts = CountsOf(reference.film);
    CHECK(counts.least >= 16 + 17 - 4);
    CHECK(counts.most > 1.3 * 50);
    CHECK(counts.all == reference.result.samples);
    CHECK(double(counts.all) == Approx(70 * 37 * 50).epsilon(0.02));
    for (int threads : {1, 3}) {
      for (std::uint32_t wavefront : {64u, 8192u}) {
        const Rendered other = RenderWith(text, strategy, 50, 1, threads, wavefront);
        INFO(strategy << ", " << threads << " threads, wavefront " << wavefront);
        CHECK(Identical(other.film, reference.film));
      }
    }
    CHECK_FALSE(Identical(RenderWith(text, strategy, 50, 2).film, reference.film));
  }
}

TEST_CASE("nothing to share out: the bits of allocation=uniform", "[allocation]") {
  const auto same = [](const std::string& text, std::uint64_t spp) {
    return Identical(RenderWith(text, "allocation=error", spp).film,
                     RenderWith(text, "allocation=uniform", spp).film);
  };
  CHECK(same(Scene(1, 1), 45));
  CHECK(same(Scene(3, 3), 45));
  CHECK(same(Scene(70, 37, 0), 45));  // black
  CHECK(same(Scene(70, 37), 3));      // no more than the pilot
  CHECK(same(Scene(70, 37), 16));
  CHECK_FALSE(same(Scene(70, 37), 45));
}

// The mean of all pixels over seeds; 5 standard errors, 6e-7 per channel. A bias of 1 %
// is found.
TEST_CASE("shared-out samples: the image's mean is that of equal ones", "[allocation]") {
  const std::string text = Scene(40, 24);
  Rgb sums[2], squares[2];
  constexpr int kSeeds = 12;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    for (int which : {0, 1}) {
      const Rgb mean =
          ImageMean(RenderWith(text, which == 0 ? "" : "allocation=error", 64,
                               static_cast<std::uint64_t>(2 * seed + which))
                        .film);
      sums[which] += mean;
      for (int c = 0; c < 3; ++c) squares[which][c] += mean[c] * mean[c];
    }
  }
  for (int c = 0; c < 3; ++c) {
    double variance = 0, mean[2];
    for (int which : {0, 1}) {
      mean[which] = sums[which][c] / kSeeds;
      variance += (squares[which][c] / kSeeds - mean[which] * mean[which]) / (kSeeds - 1);
    }
    CHECK(std::abs(mean[1] - mean[0]) < 5 * std::sqrt(variance));
    CHECK(5 * std::sqrt(variance) < 0.01 * mean[0]);
  }
}

TEST_CASE("shared-out samples lower the relative error", "[allocation]") {
  const std::string text = Scene(70, 37);
  const auto error = [&](const char* strategy) {
    const Rendered r = RenderWith(text, strategy, 256);
    double sum = 0;
    for (int y = 0; y < 37; ++y) {
      for (int x = 0; x < 70; ++x) {
        const double mean = r.film.Mean(x, y).y;
        sum += r.film.Variance(x, y).y / (mean * mean + 0.01);
      }
    }
    return sum;
  };
  CHECK(error("allocation=error") < 0.9 * error("allocation=uniform"));
}

TEST_CASE("windows have as many samples each", "[allocation]") {
  CompiledScene scene = PrepareScene(ParseSceneText(Scene(70, 37), "test.pbrt", "."), {});
  Strategy strategy = scene.strategy;
  ApplyStrategy("allocation=error", {}, strategy);
  UseStrategy(strategy, scene);
  PlanOptions plan_options;
  plan_options.max_depth = 3;
  const Plan plan = MakePlan(scene, plan_options);
  FilmAccumulator film(0, 0, 16, 8, GroupsOf(strategy), Auxiliary::kNone);
  RunOptions options;
  options.spp = 40;
  options.windows = {{0, 0, 8, 8}, {40, 16, 48, 24}};
  Run(scene, plan, options, film);
  const Counts counts = CountsOf(film);
  CHECK((counts.least == 40 && counts.most == 40));
}

}  // namespace lanelight
