// Whole renders with a film that responds otherwise than in linear sRGB: the samples are
// the same, and so is what the film holds, up to the response.
#include <catch2/catch.hpp>

#include "src/base/image/color_spaces.h"
#include "src/render/job/job.h"
#include "src/scene/parse/parse.h"

namespace lanelight {
namespace {

constexpr const char* kRoom = R"(
LookAt 0 1 -4  0 1 0  0 1 0
Camera "perspective"
Film "rgb" "integer xresolution" 12 "integer yresolution" 12
Sampler "sobol"
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.3 0.6 ]
Material "diffuse" "rgb reflectance" [ 0.8 0.3 0.1 ]
Shape "plane"
Translate 0 1 0
AreaLightSource "diffuse" "rgb L" [ 9 6 3 ]
Shape "sphere" "float radius" 1.2
)";

struct Responses {
  Job job;
  FilmAccumulator film;
};

Responses RenderWith(const FilmResponse& response, const std::string& strategy) {
  SceneDescription scene = ParseSceneText(kRoom, "room.pbrt", ".");
  scene.film.response = response;
  RenderSettings settings;
  settings.spp = 16;
  settings.strategy = ParseStrategy(strategy, {});
  Job job = PrepareJob(std::move(scene), settings);
  FilmAccumulator film = RunJob(job).film;
  return {std::move(job), std::move(film)};
}

FilmResponse Balanced() { return {FilmMatrix(FindColorSpace("rec2020"), 3500)}; }

// The film's means are the matrix times what they are without.
TEST_CASE("film response: means of a render", "[film]") {
  for (const char* strategy : {"", "seen-lights=paths"}) {
    INFO(strategy);
    const Responses plain = RenderWith({}, strategy);
    const Responses balanced = RenderWith(Balanced(), strategy);
    double largest = 0;
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x) {
        const Rgb expected = Balanced().matrix * plain.film.Mean(x, y);
        const Rgb found = balanced.film.Mean(x, y);
        for (int c = 0; c < 3; ++c) {
          CHECK(found[c] == Approx(expected[c]).epsilon(1e-5).margin(1e-6));
        }
        largest = std::max(largest, std::abs(found.x - plain.film.Mean(x, y).x));
        CHECK(balanced.film.Samples(x, y) == 16);
      }
    }
    CHECK(largest > 0.05);  // it does something
  }
}

// Variances are of what the film holds: by the scatter of the converted replicates, which
// those of the channels alone do not tell.
TEST_CASE("film response: variances are of the written values", "[film]") {
  FilmResponse sum;  // all channels hold R + G + B
  sum.matrix = {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  const Responses added = RenderWith(sum, "");
  FilmResponse twice;
  twice.matrix = {{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
  const Responses doubled = RenderWith(twice, ""), plain = RenderWith({}, "");
  double sums = 0, parts = 0;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 12; ++x) {
      const Rgb v = plain.film.Variance(x, y), d = doubled.film.Variance(x, y);
      for (int c = 0; c < 3; ++c) CHECK(d[c] == Approx(4 * v[c]).margin(1e-12));
      sums += added.film.Variance(x, y).x;
      parts += v.x + v.y + v.z;
    }
  }
  // Channels of one path go up and down together.
  CHECK(sums > 1.2 * parts);
}

TEST_CASE("film response: no sample is above the limit", "[film]") {
  FilmResponse limited;
  limited.max_component = 1.5;
  const Responses render = RenderWith(limited, "seen-lights=paths");
  const Responses plain = RenderWith({}, "seen-lights=paths");
  double maximum = 0, before = 0;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 12; ++x) {
      const Vec3d xyz = XyzFromSrgb() * render.film.Mean(x, y);
      maximum = std::max({maximum, xyz.x, xyz.y, xyz.z});
      before = std::max(before, (XyzFromSrgb() * plain.film.Mean(x, y)).y);
    }
  }
  CHECK(before > 3);  // the lamp
  CHECK(maximum <= 1.5 * (1 + 1e-6));
  CHECK(maximum > 1.4);
}

// pbrt-v4's RGBFilm::AddSample limits what each camera ray brings: of a lamp of 4, whose
// Z is 4.36, there is left what has Z = 1, whose channels are 0.918, in every sample that
// sees it, and half of that where the lamp fills half a pixel.
TEST_CASE("film response: the limit is on single camera rays", "[film]") {
  const std::string lamp = R"(
    Camera "orthographic" "float screenwindow" [ 0 1 0 1 ]
    Film "rgb" "integer xresolution" 5 "integer yresolution" 5
      "float maxcomponentvalue" 1
    PixelFilter "box"
    Sampler "sobol" "integer pixelsamples" 256
    WorldBegin
    AreaLightSource "diffuse" "rgb L" [ 4 4 4 ] "bool twosided" true
    Shape "bilinearmesh" "point3 P" [ 0.5 0 1  1 0 1  0.5 1 1  1 1 1 ])";
  Job job = PrepareJob(ParseSceneText(lamp, "lamp.pbrt", "."), {});
  FilmAccumulator film = RunJob(job).film;
  const double limited = 1 / (XyzFromSrgb() * Rgb{1, 1, 1}).z;
  CHECK(limited == Approx(0.918).epsilon(1e-3));
  for (int y = 0; y < 5; ++y) {
    CHECK(film.Mean(1, y).y == 0);
    CHECK(film.Mean(2, y).y == Approx(limited / 2).epsilon(0.03));
    CHECK(film.Mean(4, y).y == Approx(limited).epsilon(1e-4));
  }
}

}  // namespace
}  // namespace lanelight
