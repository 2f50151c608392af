// light-paths=splats in participating media: the same image as without, tile by tile, and
// caustics behind an absorber against the light of an image.
#include <catch2/catch.hpp>

#include "src/scene/parse/parse.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/media/scenes.h"
#include "tests/kernels/media/varying_scenes.h"
#include "tests/kernels/reuse/same_light.h"
#include "tests/vocabulary/strategy/combinations.h"

namespace lanelight::test {
namespace {

void CheckSplats(const SceneDescription& description, std::uint64_t spp = 8192,
                 double power = 0.03) {
  ReuseScene scene = {description, spp, power};
  CheckSame(scene, "points=sobol", "light-paths=splats:1");
}

// A mirror that the camera does not see throws light of the lamp on the floor.
void AddMirror(SceneBuilder& b) {
  b.AddQuad({1.2, -3, 0}, {0, 6, 0}, {0, 0, 2}, b.AddConductor(Grey(1e-3), Grey(1e4)));
}

// A ball of smoke over a floor, with lamps in it and beside it.
SceneBuilder LampsInSmoke(const Medium& smoke) {
  SceneBuilder b(8, 8);
  b.Depth(4).Perspective({0, -5, 1.5}, {0, 0, 0.8}, {0, 0, 1}, 36);
  const Index grey = b.AddDiffuse({0.6, 0.5, 0.4}), black = b.AddDiffuse(Grey(0));
  const Index medium = AddMedium(b, smoke);
  b.AddPlane({0, 0, -0.2}, {0, 0, 1}, grey);
  b.AddSphere({0, 0, 0.9}, 0.9, AddInterface(b));
  Bound(b, medium, kNone);
  b.AddSphere({0.3, 0.1, 0.7}, 0.1, black, b.AddEmission({9, 7, 5}));
  b.AddQuad({-0.5, 0, 1}, {0.2, 0, 0.1}, {0, 0.3, 0}, black,
            b.AddEmission({5, 7, 9}, true));
  b.AddPoint({-0.2, -0.2, 0.6}, {0.1, 0.07, 0.07});
  b.AddSpot({1.5, -0.6, 1.4}, {0, 0, 0.9}, {4, 5, 6}, 25, 8);
  return b;
}

}  // namespace

TEST_CASE("splats: fog around the camera and all lights", "[light_paths][media]") {
  CheckSplats(Fog());
  SceneDescription thick = Fog();
  thick.media[0] = MakeMedium({0.1, 0.2, 0.4}, {1.5, 1, 0.5}, -0.5);
  thick.lights.clear();
  CheckSplats(thick, 16384, 0.06);
}

TEST_CASE("splats: fog whose paths carry wavelengths", "[light_paths][media][spectral]") {
  SceneDescription scene = Fog();
  scene.integrator.transport = Transport::kSpectral;
  CheckSplats(scene);
}

TEST_CASE("splats: distances sampled around lights", "[light_paths][media]") {
  ReuseScene scene = {Fog(), 8192, 0.03};
  CheckSame(scene, "points=sobol,distances=equiangular", "light-paths=splats:2");
}

TEST_CASE("splats: media in media, behind interfaces", "[light_paths][media]") {
  CheckSplats(NestedClouds());
  CheckSplats(NestedSmoke());
}

TEST_CASE("splats: media that vary", "[light_paths][media]") {
  CheckSplats(Smoke());
  CheckSplats(BallOf(CloudLump()), 2048, 0.06);
}

TEST_CASE("splats: a medium in glass", "[light_paths][media]") {
  CheckSplats(FilledGlass(), 32768, 0.06);
}

// The file states no medium for any of these lights.
TEST_CASE("splats: lights in smoke, whose medium the file does not state",
          "[light_paths][media]") {
  const Medium thin = MakeMedium({0.3, 0.2, 0.1}, {0.8, 1, 1.5}, 0.3);
  CheckSplats(LampsInSmoke(thin).Build(), 16384, 0.08);
  Medium grid = thin;
  grid.kind = MediumKind::kUniformGrid;
  grid.grid_size[0] = grid.grid_size[1] = grid.grid_size[2] = 2;
  grid.grid = {0, 1, 2, 0.5, 1.5, 3, 0.1, 1};
  grid.box_min = {-0.9, -0.9, 0}, grid.box_max = {0.9, 0.9, 1.8};
  CheckSplats(LampsInSmoke(grid).Build(), 16384, 0.08);
}

// A lamp around the camera is filled with fog, and shines outwards too.
TEST_CASE("splats: a lamp with another medium on each side", "[light_paths][media]") {
  for (const bool inward : {false, true}) {
    SceneBuilder b(8, 8);
    b.Depth(3).Perspective({0, -1, 0}, {0, 0, 0}, {0, 0, 1}, 60);
    const Index fog = AddMedium(b, MakeMedium({0.3, 0.6, 0.9}, {0.5, 0.2, 0.4}));
    b.AddSphere({0, 0, 0}, 2, b.AddDiffuse(Grey(0)), b.AddEmission({1, 2, 3}, true));
    Bound(b, inward ? kNone : fog, inward ? fog : kNone);
    b.scene().shapes.back().reverse_orientation = inward;
    b.AddSphere({0.2, 0.3, 0.1}, 0.5, b.AddDiffuse(Grey(0.7)));
    b.scene().camera.medium = fog;
    CheckSplats(b.Build());
  }
}

// Scattered rays find most of the light of a large lamp.
TEST_CASE("splats: a large lamp behind an interface", "[light_paths][media]") {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -3, 0.6}, {0, 0, 0}, {0, 0, 1}, 40);
  const Index thin = AddMedium(b, MakeMedium({0.1, 0.2, 0.3}, {0.3, 0.2, 0.1}, 0.7));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3));
  b.AddPlane({0, 0, 0.9}, {0, 0, 1}, AddInterface(b));
  Bound(b, thin, kNone);
  b.AddQuad({-2, -2, 1.4}, {0, 4, 0}, {4, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({1, 2, 3}));
  b.scene().camera.medium = thin;
  CheckSplats(b.Build());
}

// The camera looks out of a bubble. The sky does not shine through fog without end.
SceneBuilder Bubble() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -4, 1.5}, {0, 0, 0.6}, {0, 0, 1}, 40);
  const Index fog = AddMedium(b, MakeMedium({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}));
  b.AddSphere({0, -4, 1.5}, 0.5, AddInterface(b));
  Bound(b, kNone, fog);
  b.AddQuad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, b.AddDiffuse(Grey(0.6)));
  b.AddSphere({0, 0, 0.5}, 0.4, b.AddDiffuse(Grey(0.5)));
  b.AddEnvironment({0.5, 0.7, 1});
  b.AddDistant({0.3, -0.5, 0.7}, {2, 1.5, 1});
  b.AddSphere({-0.6, 0.3, 1.2}, 0.2, b.AddDiffuse(Grey(0)), b.AddEmission({5, 7, 9}));
  return b;
}

TEST_CASE("splats: the sky is dark behind endless fog", "[light_paths][media]") {
  SceneBuilder b = Bubble();
  CheckSplats(b.Build(), 4096, 0.12);
  b.scene().camera.medium = 0;
  b.scene().shapes.erase(b.scene().shapes.begin());
  CheckSplats(b.Build(), 4096, 0.12);
}

TEST_CASE("splats: mirrors in fog", "[light_paths][media]") {
  SceneDescription scene = Fog();
  SceneBuilder b(8, 8);
  b.scene() = scene;
  AddMirror(b);
  b.scene().lights.clear();  // its caustic is that of subpaths alone
  CheckSplats(b.Build(), 32768, 0.06);
}

TEST_CASE("splats: a caustic behind an absorber is the light of the image",
          "[light_paths][media]") {
  const auto floor = [](bool mirror) {
    SceneBuilder b(8, 8);
    b.Depth(mirror ? 2 : 1).Perspective({0, 0, 4}, {0.3, 0, 0}, {0, 1, 0}, 20);
    b.AddQuad({-2, -2, 0}, {3.2, 0, 0}, {0, 4, 0}, b.AddDiffuse({0.7, 0.5, 0.3}));
    if (mirror) AddMirror(b);
    b.AddPoint({0.2, 0.1, 0.9}, {3, 2, 1});
    if (!mirror) b.AddPoint({2.2, 0.1, 0.9}, {3, 2, 1});
    b.scene().camera.medium = AddMedium(b, MakeMedium({0.2, 0.5, 1}, {}));
    return b.Build();
  };
  const auto truth = RenderOften(floor(false), "points=sobol", 4096, 1);
  const auto caustic =
      RenderOften(floor(true), "points=sobol,light-paths=splats:1", 16384, 7);
  for (const int tile : {8, 2}) {
    stat::CheckSame(stat::CompareMeans(TilesOf(caustic, tile), TilesOf(truth, tile),
                                       {1, 1e-6, kFloatTolerance, 1e-7}),
                    0.03);
  }
}

TEST_CASE("splats: materials with an inside are refused", "[light_paths][media]") {
  const char* scene = R"(
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "point"
Material "subsurface"
Translate 0 0 3
Shape "sphere"
)";
  const PreparedScene prepared =
      PrepareScene(ParseSceneText(scene, "test.pbrt", "."), {});
  CHECK_FALSE(Accepts(prepared, "light-paths=splats"));
  CHECK(Accepts(PrepareScene(Fog()), "light-paths=splats"));
}

}  // namespace lanelight::test
