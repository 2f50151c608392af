// light-paths=splats renders what camera paths alone render: the image as a whole, and
// tile by tile, as a subpath serves several pixels.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/reuse/same_light.h"
#include "tests/render/run/correlations.h"
#include "tests/render/run/render_fixture.h"
#include "tests/vocabulary/strategy/combinations.h"

namespace lanelight::test {
namespace {

void CheckSplats(ReuseScene& scene) {
  CheckSame(scene, "points=sobol", "light-paths=splats:2");
}

ReuseScene Room() { return {SmallRoom(8, 4, 0.3)}; }

Material Coat(double roughness) {
  Material coat;
  coat.kind = MaterialKind::kCoatedDiffuse;
  coat.reflectance.constant = Grey(0.6);
  coat.uroughness.constant = coat.vroughness.constant = roughness;
  coat.remap_roughness = false;
  return coat;
}

Material Metal(double alpha) {
  Material metal;
  metal.kind = MaterialKind::kConductor;
  metal.eta.constant = {0.2, 0.9, 1.1};
  metal.k.constant = {3.9, 2.5, 2.2};
  metal.uroughness.constant = metal.vroughness.constant = alpha;
  metal.remap_roughness = false;
  return metal;
}

}  // namespace

TEST_CASE("splats: a room of diffuse walls, with a box and a mirror", "[light_paths]") {
  ReuseScene room = Room();
  CheckSplats(room);
  CheckSame(room, "points=independent", "light-paths=splats:7");
  CheckSame(room, "points=sobol,roulette=throughput:0:1:4", "light-paths=splats:1");
  CheckSame(room, "points=sobol,light-points=solid-angle", "light-paths=splats");
  room.description.integrator.max_depth = 1;
  room.truths.clear();
  CheckSplats(room);
}

TEST_CASE("splats: materials of other kinds connect to the camera, or do not",
          "[light_paths]") {
  Material leaf;
  leaf.kind = MaterialKind::kDiffuseTransmission;
  leaf.reflectance.constant = {0.4, 0.3, 0.2};
  leaf.transmittance.constant = {0.2, 0.3, 0.5};
  Material glass;
  glass.kind = MaterialKind::kDielectric;
  glass.eta.constant = Grey(1.5);
  Material frosted = glass;
  frosted.uroughness.constant = frosted.vroughness.constant = 0.3;
  frosted.remap_roughness = false;
  for (const Material& side :
       {leaf, Metal(0.2), Metal(0), Coat(0), Coat(0.3), glass, frosted}) {
    INFO(static_cast<int>(side.kind) << ", " << side.uroughness.constant);
    ReuseScene room = WithSides(side, 4);
    room.spp = 4096;
    room.power = 0.03;
    CheckSplats(room);
  }
}

TEST_CASE("splats: lamps of every shape, of one and two sides", "[light_paths]") {
  SceneBuilder b(8, 8);
  b.Depth(4).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  const Index ground = b.AddDiffuse({0.5, 0.4, 0.3}), dark = b.AddDiffuse(Grey(0));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, ground);
  b.AddQuad({-1.5, 0.9, 0}, {3, 0, 0}, {0, 0, 2}, ground);
  b.AddSphere({-0.9, 0.2, 0.6}, 0.15, dark, b.AddEmission({9, 7, 5}));
  b.AddDisk({-0.2, 0.3, 1.2}, {0.3, 0, -1}, 0.2, dark, b.AddEmission({8, 9, 6}));
  b.AddQuad({0.4, 0, 1}, {0, 0.3, 0}, {0.3, 0, 0.1}, dark, b.AddEmission({9, 9, 9}));
  b.AddQuad({1, 0, 1}, {0, 0.3, 0}, {0.3, 0, 0.1}, dark, b.AddEmission({9, 5, 3}, true));
  b.AddPoint({0, -1, 2}, {0.5, 0.5, 0.5});
  ReuseScene lamps = {b.Build()};
  CheckSplats(lamps);
  CheckSame(lamps, "points=sobol,light-selection=tree", "light-paths=splats:2");
  CheckSame(lamps, "points=sobol,light-candidates=resampled", "light-paths=splats:2");
}

TEST_CASE("splats: paths that carry wavelengths", "[light_paths][spectral]") {
  ReuseScene room = Room();
  room.description.materials[1].reflectance.constant = {0.8, 0.05, 0.03};
  room.description.materials[2].reflectance.constant = {0.04, 0.2, 0.8};
  room.description.integrator.transport = Transport::kSpectral;
  CheckSplats(room);
}

TEST_CASE("splats: pixel filters and lenses", "[light_paths]") {
  ReuseScene room = Room();
  room.description.filter = {FilterKind::kGaussian, 1.5, 1.2};
  room.description.filter.sigma = 0.5;
  CheckSplats(room);
  ReuseScene sharp = Room();
  sharp.description.filter = {FilterKind::kMitchell, 2, 2};
  CheckSplats(sharp);
  ReuseScene blurred = Room();
  blurred.description.camera.lens_radius = 0.2;
  blurred.description.camera.focal_distance = 2.5;
  CheckSplats(blurred);
}

TEST_CASE("splats: shading normals that differ from the geometry", "[light_paths]") {
  ReuseScene room = Room();
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0.3}, {1, -1, 0.3}, {1, 1, 0.3}, {-1, 1, 0.3}};
  mesh.normals = {{-0.6, -0.3, 1}, {0.5, -0.4, 1}, {0.4, 0.6, 1}, {-0.3, 0.5, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  SceneBuilder builder(8, 8);
  builder.scene() = room.description;
  builder.AddMesh(mesh, 0);
  room.description = builder.Build();
  CheckSplats(room);
}

// Light reaches the wall that the camera sees by way of a floor with tilted normals.
TEST_CASE("splats: light leaves a surface by its shading normal", "[light_paths]") {
  SceneBuilder b(8, 8);
  b.Depth(2).Perspective({-3, 0, 0.8}, {0, 0, 0.8}, {0, 0, 1}, 30);
  const Index grey = b.AddDiffuse(Grey(0.8)), black = b.AddDiffuse(Grey(0));
  TriangleMesh floor;
  floor.positions = {{-2, -2, 0}, {1, -2, 0}, {1, 2, 0}, {-2, 2, 0}};
  floor.normals.assign(4, {0.75, 0.2, 0.63});
  floor.indices = {0, 1, 2, 0, 2, 3};
  b.AddMesh(floor, grey);
  b.AddQuad({1, -2, 0}, {0, 0, 2}, {0, 4, 0}, grey);
  // A lamp close over the floor, which it alone lights.
  b.AddQuad({-0.2, -0.3, 0.3}, {0, 0.6, 0}, {0.6, 0, 0}, black, b.AddEmission({9, 9, 9}));
  ReuseScene scene = {b.Build()};
  CheckSame(scene, "points=sobol", "light-paths=splats:1");
}

// A lamp over a floor beside a mirror, which the camera does not see; or, instead of the
// mirror, the image of the lamp in it.
SceneDescription LampAndMirror(bool mirror) {
  SceneBuilder b(8, 8);
  b.Depth(mirror ? 2 : 1).Perspective({0, 0, 4}, {0.3, 0, 0}, {0, 1, 0}, 20);
  const Index floor = b.AddDiffuse({0.7, 0.5, 0.3}), black = b.AddDiffuse(Grey(0));
  const Index lamp = b.AddEmission({60, 50, 40});
  b.AddPlane({0, 0, 0}, {0, 0, 1}, floor);
  b.AddQuad({0.2, -0.05, 0.9}, {0, 0.1, 0}, {0.1, 0, 0}, black, lamp);
  if (mirror) {
    b.AddQuad({1.2, -3, 0}, {0, 6, 0}, {0, 0, 2}, b.AddConductor(Grey(1e-3), Grey(1e4)));
  } else {
    b.AddQuad({2.1, -0.05, 0.9}, {0, 0.1, 0}, {0.1, 0, 0}, black, lamp);
  }
  return b.Build();
}

TEST_CASE("splats: a caustic of a plane mirror is the light of the lamp's image",
          "[light_paths]") {
  const auto image = RenderOften(LampAndMirror(false), "points=sobol", 16384, 1);
  const auto caustic =
      RenderOften(LampAndMirror(true), "points=sobol,light-paths=splats:1", 16384, 7);
  for (const int tile : {8, 2}) {
    stat::CheckSame(stat::CompareMeans(TilesOf(caustic, tile), TilesOf(image, tile),
                                       {1, 1e-6, kFloatTolerance, 1e-7}),
                    0.03);
  }
}

TEST_CASE("splats: a wall that is 3 % darker is found", "[light_paths]") {
  ReuseScene room = Room();
  const auto truth = TilesOf(RenderOften(room.description, "points=sobol", 32768, 1), 8);
  for (Material& material : room.description.materials) {
    material.reflectance.constant *= 0.97;
  }
  const auto darker = TilesOf(
      RenderOften(room.description, "points=sobol,light-paths=splats:2", 8192, 7), 8);
  CHECK_FALSE(stat::CompareMeans(darker, truth, {1, 1e-6, kFloatTolerance, 1e-7}).same);
}

// A point light that reaches the floor by way of a mirror alone, on light subpaths.
SceneDescription CausticAlone() {
  SceneBuilder b(16, 16);
  b.Depth(2).Perspective({0, 0, 4}, {0.3, 0, 0}, {0, 1, 0}, 20);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.7, 0.5, 0.3}));
  b.AddPoint({0.25, 0, 0.9}, {1, 1, 1});
  b.AddQuad({0.2, -0.05, 0.85}, {0, 0.1, 0}, {0.1, 0, 0}, b.AddDiffuse(Grey(0)));
  b.AddQuad({1.2, -3, 0}, {0, 6, 0}, {0, 0, 2}, b.AddConductor(Grey(1e-3), Grey(1e4)));
  return b.Build();
}

TEST_CASE("splats: errors of pixels are no more correlated than the film states",
          "[light_paths]") {
  SceneDescription scene = CausticAlone();
  for (const double sigma : {0.5, 1.5}) {
    scene.filter = {FilterKind::kGaussian, 3 * sigma, 3 * sigma};
    scene.filter.sigma = sigma;
    std::vector<std::vector<double>> renders;
    double dependents = 0;
    TestRender render;
    render.spp = 32;
    render.strategy = "light-paths=splats:1";
    for (; render.seed <= 48; ++render.seed) {
      const FilmAccumulator film = RenderDescription(scene, render).film;
      dependents = film.groups().dependents;
      renders.emplace_back();
      ForEachPixel(film,
                   [&](int x, int y) { renders.back().push_back(film.Mean(x, y).y); });
    }
    const double measured = SquaredCorrelations(renders);
    INFO(measured << " of " << dependents);
    CHECK(measured < dependents);
    CHECK(measured > dependents / 6);
  }
}

TEST_CASE("splats: what light subpaths do not support is refused, with a remedy",
          "[light_paths]") {
  const auto refuses = [](SceneDescription scene, const std::string& strategy) {
    return !Accepts(PrepareScene(scene), "light-paths=splats," + strategy);
  };
  const SceneDescription room = Room().description;
  CHECK_FALSE(refuses(room, "points=sobol"));
  CHECK(refuses(room, "reuse=block"));
  CHECK(refuses(room, "decide=pilot"));
  CHECK(refuses(room, "roulette=adjoint"));
  SceneDescription other = room;
  other.film.response.max_component = 10;
  CHECK(refuses(other, "points=sobol"));
  other = room;
  other.camera.kind = CameraKind::kOrthographic;
  CHECK(refuses(other, "points=sobol"));
}

}  // namespace lanelight::test
