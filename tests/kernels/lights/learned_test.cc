// light-selection=learned renders the same image as light-selection=power, with less
// noise where lights are hidden from parts of the scene; trial runs choose it.
#include <catch2/catch.hpp>

#include "tests/kernels/reuse/same_light.h"

namespace lanelight::test {
namespace {

// Two rooms without a ceiling beside each other, x < 0 and x > 0. The camera sees the
// first, with one large lamp; small ones hang between x = `left` and 1.8.
SceneBuilder Rooms(int lamps, double left) {
  SceneBuilder b(8, 8);
  b.Depth(4).Perspective({-1, -0.9, 1}, {-1.2, 0.5, 0.6}, {0, 0, 1}, 70);
  const Index white = b.AddDiffuse({0.7, 0.6, 0.5}), red = b.AddDiffuse({0.8, 0.3, 0.2});
  b.AddQuad({-2, -1, 0}, {4, 0, 0}, {0, 2, 0}, white);
  for (const double y : {-1.0, 1.0}) b.AddQuad({-2, y, 0}, {4, 0, 0}, {0, 0, 2}, white);
  for (const double x : {-2.0, 2.0}) b.AddQuad({x, -1, 0}, {0, 2, 0}, {0, 0, 2}, white);
  b.AddBox({-0.05, -1, 0}, {0.05, 0.95, 2}, red);
  b.AddSphere({-1.4, 0.2, 0.4}, 0.3, b.AddConductor(Grey(0.2), Grey(3), 0.2));
  b.AddQuad({-1.2, -0.2, 1.99}, {0.3, 0, 0}, {0, -0.3, 0}, white,
            b.AddEmission({3, 2, 1}));
  for (int i = 0; i < lamps; ++i) {
    const double at = left + (1.8 - left) * i / lamps;
    b.AddSphere({at, -0.5 + 0.9 * (i % 2), 0.5 + 0.1 * (i % 9)}, 0.01, 0,
                b.AddEmission(Grey(3e4 / lamps)));
  }
  return b;
}

}  // namespace

TEST_CASE("learned selection of lights is unbiased in every tile", "[strategy]") {
  // One light for each group, and many for each.
  for (const int lamps : {3, 150}) {
    INFO(lamps << " lamps");
    SceneBuilder b = Rooms(lamps, lamps == 3 ? 0.3 : -1.8);
    b.AddEnvironment({0.9, 1.2, 1.5});
    b.AddDistant({0.3, 0.1, 1}, {1, 1, 1});
    ReuseScene scene = {b.Build(), 4096, 0.03};
    CheckSame(scene, "points=sobol", "light-selection=learned");
    CheckSame(scene, "points=sobol,light-candidates=resampled",
              "light-selection=learned");
    CheckSame(scene, "points=sobol,reuse=block:16", "light-selection=learned");
    CheckSame(scene, "points=independent,roulette=adjoint", "light-selection=learned");
  }
}

TEST_CASE("a trial run learns to select lights where walls hide most of them",
          "[strategy][decision]") {
  SceneDescription scene = Rooms(8, 0.3).Build();
  scene.film.width = scene.film.height = 32;
  TestRender options;
  options.spp = 8;
  options.planned_samples = 1 << 21;
  options.strategy = "points=sobol,seen-lights=paths,decide=pilot";
  const Rendered chosen = RenderDescription(scene, options);
  INFO(chosen.result.training.note);
  const std::string changes = chosen.result.training.changes;
  CHECK_THAT(changes, Catch::Contains("light-selection=learned"));
  // The image is what it is with that asked for.
  options.strategy = "points=sobol,seen-lights=paths," + changes;
  const Rendered asked = RenderDescription(scene, options);
  CHECK(Identical(chosen.film, asked.film));
}

}  // namespace lanelight::test
