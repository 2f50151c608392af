// Scenes in which rays can hit nothing: the image is that of the environment, or black.
#include <catch2/catch.hpp>

#include "tests/render/run/render_fixture.h"

namespace lanelight {
namespace {

using Catch::Contains;

const char* kEmpty = R"(
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
)";
const char* kSky = R"(
LightSource "infinite" "rgb L" [ 0.25 0.5 2 ]
)";
// On one line, so that they have no area.
const char* kDegenerate = R"(
Shape "trianglemesh" "point3 P" [ 0 0 0  1 1 1  2 2 2 ] "integer indices" [ 0 1 2 ]
)";

std::vector<std::string> ScenesWithoutSurfaces() {
  const std::string degenerate = kDegenerate;
  return {
      "",
      degenerate,
      R"(Texture "c" "spectrum" "checkerboard" Material "diffuse" "texture reflectance" "c")" +
          degenerate,
      "Shape \"sphere\" \"float alpha\" 0",
      "Material \"interface\" Shape \"sphere\"",
      "ObjectBegin \"a\" ObjectEnd ObjectInstance \"a\"",
      "ObjectBegin \"a\"" + degenerate + "ObjectEnd ObjectInstance \"a\"",
      "AreaLightSource \"diffuse\" \"rgb L\" [ 9 9 9 ]" + degenerate,
      "LightSource \"point\" \"rgb I\" [ 9 9 9 ] LightSource \"distant\"",
  };
}

void CheckAll(const FilmAccumulator& film, const Rgb& radiance) {
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      REQUIRE(film.Samples(x, y) == 16);
      REQUIRE(film.Mean(x, y) == radiance);
      REQUIRE(film.Variance(x, y) == Rgb{});
    }
  }
}

}  // namespace

TEST_CASE("a scene without surfaces shows its environment or black", "[plan]") {
  for (const std::string& body : ScenesWithoutSurfaces()) {
    for (const char* strategy :
         {"", "points=sobol,light-selection=tree", "roulette=adjoint,directions=light",
          "control=regression", "environment=compensated",
          "pairs=antithetic,directions=uniform"}) {
      for (const Auxiliary auxiliary : {Auxiliary::kNone, Auxiliary::kGbuffer}) {
        CAPTURE(body, strategy, int(auxiliary));
        TestRender test;
        test.strategy = strategy;
        test.auxiliary = auxiliary;
        CheckAll(RenderText(std::string(kEmpty) + kSky + body, test).film,
                 {0.25, 0.5, 2});
        CheckAll(RenderText(kEmpty + body, test).film, {});
      }
    }
  }
}

TEST_CASE("a scene without surfaces has no surface stages", "[plan]") {
  const Rendered r = RenderText(std::string(kEmpty) + kSky + kDegenerate);
  std::string stages;
  for (const PlannedStage& s : r.plan.paths().stages)
    stages += std::string(s.stage.name) + " ";
  CHECK(stages ==
        "generate points_camera_independent camera_perspective hits escape max_depth "
        "accumulate compact ");
  CHECK(r.result.rays_shadow == 0);
}

TEST_CASE("each kind of surface alone is rendered", "[plan]") {
  for (const char* shape :
       {"Shape \"sphere\"", "Shape \"disk\"", "Shape \"plane\"",
        "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ]",
        "ObjectBegin \"a\" Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ] "
        "ObjectEnd ObjectInstance \"a\"",
        // Much larger than its distance.
        "Translate 0 -1e7 0 Shape \"sphere\" \"float radius\" 9999999"}) {
    INFO(shape);
    const PreparedScene scene = PrepareScene(
        ParseSceneText(std::string(kEmpty) + kSky + shape, "one.pbrt", "."), {});
    CHECK(MakePlan(scene, {}).features.Has(Feature::kScatters));
    CHECK(scene.compiled->notes.empty());
  }
}

TEST_CASE("a scene without surfaces gets a note", "[plan]") {
  const auto note = [](const std::string& text) {
    const PreparedScene scene = PrepareScene(ParseSceneText(text, "empty.pbrt", "."), {});
    REQUIRE_FALSE(scene.compiled->notes.empty());
    return scene.compiled->notes.back().where.ToString() + ": " +
           scene.compiled->notes.back().message;
  };
  CHECK_THAT(note(kEmpty), Contains("empty.pbrt: the scene has no shape") &&
                               Contains("the image is black"));
  CHECK_THAT(note(std::string(kEmpty) + kSky), Contains("the environment alone"));
  const std::string solid = std::string(kEmpty) + "Shape \"sphere\"";
  CHECK(CompileScene(ParseSceneText(solid, "a.pbrt", "."), {}).notes.empty());
}

TEST_CASE("auxiliary output without scattering is refused", "[plan]") {
  const PreparedScene scene = PrepareScene(
      ParseSceneText(std::string(kEmpty) + "Shape \"sphere\"", "a.pbrt", "."), {});
  PlanOptions options;
  options.max_depth = 0;
  CHECK_NOTHROW(MakePlan(scene, options));
  options.auxiliary = Auxiliary::kGbuffer;
  CHECK_THROWS_WITH(MakePlan(scene, options), Contains("maximum depth of at least 1"));
}

}  // namespace lanelight
