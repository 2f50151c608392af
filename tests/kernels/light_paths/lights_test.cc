// light-paths=splats with lights of every kind: the same image as without, and caustics
// of lights without extent against closed forms.
#include <catch2/catch.hpp>

#include "src/render/plan/plan.h"
#include "src/render/plan/plan_features.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/lights/pictures.h"
#include "tests/kernels/reuse/same_light.h"
#include "tests/vocabulary/strategy/combinations.h"

namespace lanelight::test {
namespace {

constexpr std::uint64_t kSpp = 4096;

void CheckSame(ReuseScene& scene) {
  CheckSame(scene, "points=sobol", "light-paths=splats:2");
}

// A floor, walls with a glossy one, and a ball; no mirrors, whose caustics of lights
// without extent only light subpaths find. The camera sees little of what is behind it.
SceneBuilder Corner() {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -3.2, 1.5}, {0, 0, 0.7}, {0, 0, 1}, 40);
  const Index white = b.AddDiffuse({0.7, 0.6, 0.5}), red = b.AddDiffuse({0.8, 0.2, 0.1});
  const Index glossy = b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3);
  b.AddQuad({-1.5, -4, 0}, {3, 0, 0}, {0, 5.5, 0}, white);
  b.AddQuad({-1.5, 1.5, 0}, {3, 0, 0}, {0, 0, 2.5}, white);
  b.AddQuad({-1.5, -4, 0}, {0, 5.5, 0}, {0, 0, 2.5}, red);
  b.AddQuad({1.5, 1.5, 0}, {0, -3, 0}, {0, 0, 2}, glossy);
  b.AddSphere({0.4, 0.2, 0.5}, 0.4, glossy);
  return b;
}

ReuseScene Lit(SceneBuilder b) { return {b.Build(), kSpp, 0.04}; }

Light WithPicture(LightKind kind, const Transform& place) {
  Light light;
  light.kind = kind;
  light.image_path = kind == LightKind::kGoniometric
                         ? Picture("round.exr", 4, 4, Patchwork)
                         : Picture("slide.exr", 6, 4, Patchwork);
  light.emission = {2, 3, 4};
  light.fov = 60;
  light.world_from_light = place;
  return light;
}

}  // namespace

TEST_CASE("splats: point lights in and out of view", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddPoint({-0.6, 0.3, 1.2}, {1, 1.5, 2});
  b.AddPoint({0.2, -3.6, 1.7}, {3, 2, 1});
  ReuseScene scene = Lit(b);
  CheckSame(scene);
  CheckSame(scene, "points=sobol,light-selection=tree", "light-paths=splats:1");
}

TEST_CASE("splats: a point light at the floor", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddPoint({-0.5, -0.3, 0.03}, {0.2, 0.2, 0.1});
  ReuseScene scene = Lit(b);
  scene.power = 0.06;
  CheckSame(scene);
}

// Light samples select lights by power; each of these would leave the other none.
TEST_CASE("splats: lights far from the scene", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddPoint({-900, -1200, 2600}, {9e6, 9e6, 6e6});
  ReuseScene scene = Lit(b);
  CheckSame(scene);
  SceneBuilder spot = Corner();
  spot.AddSpot({-40, -60, 80}, {0, 0, 0.5}, {2e4, 2e4, 1e4}, 30, 10);
  ReuseScene other = Lit(spot);
  CheckSame(other);
}

TEST_CASE("splats: spots, of wide and narrow cones", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddSpot({-0.8, -0.5, 1.6}, {0, 0.5, 0.4}, {6, 5, 4}, 40, 15);
  b.AddSpot({1, -1, 2}, {-0.3, 0.2, 0}, {90, 90, 50}, 6, 1);
  ReuseScene scene = Lit(b);
  CheckSame(scene);
}

TEST_CASE("splats: spots that are stretched, goniometric and projection lights",
          "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddSpot({-0.5, -0.3, 1}, {0.1, 0.3, 0.3}, {6, 5, 4}, 35, 20);
  b.scene().lights[0].world_from_light =
      Transform::Translate({0, 0, 0.4}) * Transform::Scale({1, 1.2, 0.8});
  b.scene().lights.push_back(WithPicture(
      LightKind::kGoniometric,
      Transform::Translate({0.6, -0.6, 1.3}) * Transform::Rotate(70, {1, 0.4, -0.2})));
  b.scene().lights.push_back(WithPicture(
      LightKind::kProjection,
      Transform::Translate({-0.2, -1.5, 1.4}) * Transform::Rotate(-100, {1, 0.1, 0.1})));
  ReuseScene scene = Lit(b);
  CheckSame(scene);
}

TEST_CASE("splats: distant lights", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddDistant({0.3, -0.5, 0.7}, {2, 1.5, 1});
  ReuseScene scene = Lit(b);
  CheckSame(scene);
  // Beside lamps, and across the scene.
  b.AddDistant({-0.6, 0.1, 0.05}, {1, 2, 3});
  b.AddPoint({-0.6, 0.3, 1.2}, {1, 1.5, 2});
  ReuseScene mixed = Lit(b);
  CheckSame(mixed);
}

Light Sky(const std::string& name, double brightest) {
  Light light;
  light.kind = LightKind::kInfinite;
  light.image_path = Picture(name, 8, 8, [=](int x, int y) {
    const bool sun = x == 3 && y == 2;
    return sun ? Rgb{brightest, brightest, brightest / 2} : 0.2 * Patchwork(x, y);
  });
  light.world_from_light = Transform::Rotate(30, {0.4, 1, 0.2});
  return light;
}

TEST_CASE("splats: constant infinite lights", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddEnvironment({0.5, 0.7, 1});
  ReuseScene scene = Lit(b);
  CheckSame(scene);
}

TEST_CASE("splats: infinite lights with an image", "[light_paths]") {
  SceneBuilder b = Corner();
  b.scene().lights.push_back(Sky("sky.exr", 30));
  ReuseScene scene = Lit(b);
  CheckSame(scene);
  CheckSame(scene, "points=sobol,environment=compensated", "light-paths=splats:2");
}

// The disk does not cover all of the planes that the camera sees, and lies below the
// ground in part.
TEST_CASE("splats: lights at infinity over infinite planes", "[light_paths]") {
  SceneBuilder b(8, 8);
  b.Depth(3).Perspective({0, -6, 1.6}, {0, 0, 0.5}, {0, 0, 1}, 60);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.6, 0.5, 0.4}));
  b.AddPlane({0, 3, 0}, {0, -1, 0}, b.AddDiffuse({0.3, 0.5, 0.7}));
  b.AddSphere({0.4, 0.2, 0.5}, 0.5,
              b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3));
  b.AddSphere({-0.9, 0.1, 0.4}, 0.4, 0);
  b.AddDistant({0.9, -0.3, 0.3}, {2, 1.5, 1});
  ReuseScene sun = Lit(b);
  CheckSame(sun, "points=sobol", "light-paths=splats:1");
  b.scene().lights.clear();
  b.scene().lights.push_back(Sky("plane.exr", 10));
  ReuseScene sky = Lit(b);
  CheckSame(sky, "points=sobol", "light-paths=splats:1");
}

TEST_CASE("splats: several infinite lights are weighed together", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddEnvironment(Grey(0.4));
  b.scene().lights.push_back(Sky("first.exr", 10));
  b.scene().lights.push_back(Sky("second.exr", 3));
  b.AddDistant({0.3, -0.5, 0.7}, {1, 0.7, 0.5});
  ReuseScene scene = Lit(b);
  scene.spp = 16384;
  CheckSame(scene, "points=sobol", "light-paths=splats:1");
}

TEST_CASE("splats: light that a portal lets in keeps its weight", "[light_paths]") {
  SceneBuilder b = Corner();
  b.scene().lights.push_back(Sky("window.exr", 10));
  b.scene().lights[0].portal = {{-2, -3, 2}, {-2, 2, 2}, {2, 2, 2}, {2, -3, 2}};
  b.AddEnvironment(Grey(0.5));
  b.AddPoint({-0.6, 0.3, 1.2}, Grey(0.3));
  ReuseScene scene = Lit(b);
  CheckSame(scene, "points=sobol", "light-paths=splats:1");
}

TEST_CASE("splats: lights that start subpaths, and those that do not", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddDistant({0.3, -0.5, 0.7}, {1, 0.7, 0.5});
  b.AddEnvironment({0.5, 0.7, 1});
  const auto starts = [&](std::initializer_list<bool> lights) {
    const PreparedScene scene = PrepareScene(b.Build());
    CHECK(scene.chances->emission.empty());
    Strategy strategy = scene.strategy;
    strategy.light_paths = LightPaths::kSplats;
    const auto chances = MakeLightChances(*scene.compiled, strategy);
    std::vector<bool> found;
    for (const float pmf : chances.emission.pmf) found.push_back(pmf > 0);
    CHECK(found == std::vector<bool>(lights));
  };
  starts({true, true});
  b.AddPoint({0, 0, 1}, Grey(1));
  starts({true, true, true});
  // Subpaths would find only a part of the light of a ray that leaves the scene.
  b.scene().lights.push_back(Sky("door.exr", 10));
  b.scene().lights.back().portal = {{-2, -3, 2}, {-2, 2, 2}, {2, 2, 2}, {2, -3, 2}};
  starts({true, false, true, false});
  b.scene().lights.pop_back();
  b.AddPlane({0, 0, -1}, {0, 0, 1}, 0).alpha.constant = 0.5;
  starts({false, false, true});
  b.scene().lights.pop_back();
  starts({});
  const PreparedScene scene = PrepareScene(b.Build());
  PlanOptions options;
  options.strategy = scene.strategy;
  options.strategy->light_paths = LightPaths::kSplats;
  const PreparedScene planned = WithStrategy(scene, *options.strategy);
  CHECK_FALSE(PlanFeatures(planned, options).Has(Feature::kLightPaths));
  CHECK(CheckStrategy(planned, options).size() == 1);
}

TEST_CASE("splats: spectral paths from lights of every kind", "[light_paths][spectral]") {
  SceneBuilder b = Corner();
  b.scene().integrator.transport = Transport::kSpectral;
  b.AddEnvironment({0.5, 0.3, 0.1});
  b.AddDistant({0.3, -0.5, 0.7}, {0.2, 0.3, 0.9});
  b.AddPoint({-0.6, 0.3, 1.2}, {1, 0.3, 0.1});
  b.scene().lights.push_back(Sky("spectral.exr", 10));
  b.scene().lights.push_back(WithPicture(
      LightKind::kProjection,
      Transform::Translate({-0.2, -1.5, 1.4}) * Transform::Rotate(-100, {1, 0.1, 0.1})));
  ReuseScene scene = Lit(b);
  CheckSame(scene);
}

// A lamp that shines to both sides hangs between walls; only its back lights what is
// behind it.
TEST_CASE("splats: shapes with two sides", "[light_paths]") {
  SceneBuilder b = Corner();
  const Index black = b.AddDiffuse(Grey(0));
  b.AddQuad({-0.9, 0.6, 0.9}, {0.6, 0, 0}, {0.1, 0.1, 0.5}, black,
            b.AddEmission({9, 7, 5}, true));
  b.AddDisk({0.8, -0.6, 1.2}, {1, 1, 0.3}, 0.25, black, b.AddEmission({5, 7, 9}, true));
  b.AddSphere({-0.7, -0.4, 0.4}, 0.15, black, b.AddEmission({9, 5, 9}, true));
  b.AddDisk({-0.7, -0.4, 0.9}, {0, 0, 1}, 0.2, black, b.AddEmission({5, 5, 3}));
  ReuseScene scene = Lit(b);
  CheckSame(scene);
}

TEST_CASE("splats: shapes with an image", "[light_paths]") {
  SceneBuilder b = Corner();
  const Index black = b.AddDiffuse(Grey(0));
  const auto picture = [&](Rgb scale) {
    const Index light = b.AddEmission(scale, true);
    b.scene().area_lights[static_cast<std::size_t>(light)].image_path = Picture(
        "steep.exr", 4, 4,
        [](int x, int y) { return Rgb{x < 2 ? 0.1 : 2.0, y < 2 ? 0.1 : 2.0, 1}; });
    return light;
  };
  b.AddQuad({-0.9, 0.6, 0.9}, {0.8, 0, 0}, {0, 0, 0.8}, black, picture({9, 7, 5}));
  b.AddDisk({0.8, -0.6, 1.2}, {1, 1, 0.3}, 0.3, black, picture({5, 7, 9}));
  b.AddSphere({-0.7, -0.4, 0.4}, 0.2, black, picture({9, 5, 9}));
  TriangleMesh triangle;
  triangle.positions = {{-0.2, -1, 1.5}, {0.3, -1, 1.5}, {0.3, -0.5, 1.4}};
  triangle.uvs = {{0, 0}, {1, 0}, {0.2, 0.9}};
  triangle.indices = {0, 1, 2};
  b.AddMesh(triangle, black, picture({7, 7, 7}));
  b.AddQuad({0, 0.5, 1.6}, {0.3, 0, 0}, {0, 0.3, 0}, black, b.AddEmission({5, 5, 3}));
  ReuseScene scene = Lit(b);
  CheckSame(scene);
}

// A lamp of alpha 0 shines as if it were whole, but no ray meets it.
TEST_CASE("splats: emitting shapes with alpha", "[light_paths]") {
  SceneBuilder b = Corner();
  Texture holes;
  holes.kind = TextureKind::kCheckerboard;
  holes.is_float = true;
  holes.mapping.su = holes.mapping.sv = 2;
  holes.tex1.constant = Grey(1);
  holes.tex2.constant = Grey(0.1);
  b.scene().textures = {holes};
  const Index black = b.AddDiffuse(Grey(0));
  const auto lamp = [&](Rgb color) { return b.AddEmission(color, true); };
  b.AddQuad({-0.9, 0.6, 0.9}, {0.8, 0, 0}, {0, 0, 0.8}, black, lamp({9, 7, 5}))
      .alpha.texture = 0;
  b.AddDisk({0.8, -0.6, 1.2}, {1, 1, 0.3}, 0.3, black, lamp({5, 7, 9})).alpha.texture = 0;
  b.AddSphere({-0.7, -0.4, 0.4}, 0.2, black, lamp({9, 5, 9})).alpha.constant = 0.4;
  b.AddQuad({0, 0.5, 1.6}, {0.3, 0, 0}, {0, 0.3, 0}, black, lamp({2, 2, 1}))
      .alpha.constant = 0;
  ReuseScene scene = Lit(b);
  CheckSame(scene, "points=sobol", "light-paths=splats:1");
}

// Both kinds of paths see textures through the footprint of a pixel.
TEST_CASE("splats: bump maps and filtered textures", "[light_paths]") {
  SceneBuilder b = Corner();
  Texture heights;
  heights.kind = TextureKind::kImage;
  heights.is_float = true;
  heights.path = Picture("heights.exr", 8, 8,
                         [](int x, int y) { return Grey(0.1 * ((x + y) % 4)); });
  heights.scale = 0.4;
  Texture checks;
  checks.kind = TextureKind::kCheckerboard;
  checks.filter = ImageFilter::kEwa;
  checks.mapping.su = checks.mapping.sv = 9;
  checks.tex1.constant = Grey(0.9);
  checks.tex2.constant = Grey(0.1);
  b.scene().textures = {heights, checks};
  b.scene().materials[0].displacement.texture = 0;
  b.scene().materials[1].reflectance.texture = 1;
  b.AddPoint({-0.6, 0.3, 1.2}, {1, 1.5, 2});
  b.AddQuad({0.4, 0, 1.6}, {0, 0.4, 0}, {0.4, 0, 0}, 0, b.AddEmission({5, 5, 5}));
  ReuseScene scene = Lit(b);
  CheckSame(scene, "points=sobol", "light-paths=splats:1");
}

// Lights over a floor beside a mirror that the camera does not see; or, instead of the
// mirror, the images of the lights in it.
SceneBuilder FloorWith(bool mirror) {
  SceneBuilder b(8, 8);
  b.Depth(mirror ? 2 : 1).Perspective({0, 0, 4}, {0.3, 0, 0}, {0, 1, 0}, 20);
  b.AddQuad({-2, -2, 0}, {3.2, 0, 0}, {0, 4, 0}, b.AddDiffuse({0.7, 0.5, 0.3}));
  const Index metal = b.AddConductor(Grey(1e-3), Grey(1e4));
  if (mirror) b.AddQuad({1.2, -3, 0}, {0, 6, 0}, {0, 0, 4}, metal);
  return b;
}

void CheckCaustic(const SceneBuilder& mirror, const SceneBuilder& images) {
  const auto truth = RenderOften(images.Build(), "points=sobol", 4096, 1);
  const auto caustic =
      RenderOften(mirror.Build(), "points=sobol,light-paths=splats:1", 16384, 7);
  for (const int tile : {8, 2}) {
    stat::CheckSame(stat::CompareMeans(TilesOf(caustic, tile), TilesOf(truth, tile),
                                       {1, 1e-6, kFloatTolerance, 1e-7}),
                    0.03);
  }
}

TEST_CASE("splats: a point light's caustic of a plane mirror is the light of its image",
          "[light_paths]") {
  SceneBuilder mirror = FloorWith(true), images = FloorWith(false);
  mirror.AddPoint({0.2, 0.1, 0.9}, {3, 2, 1});
  images.AddPoint({0.2, 0.1, 0.9}, {3, 2, 1});
  images.AddPoint({2.2, 0.1, 0.9}, {3, 2, 1});
  CheckCaustic(mirror, images);
}

TEST_CASE("splats: a spot's caustic of a plane mirror is the light of its image",
          "[light_paths]") {
  SceneBuilder mirror = FloorWith(true), images = FloorWith(false);
  mirror.AddSpot({-0.2, 0.1, 1.2}, {1.2, 0, 0.6}, {9, 6, 3}, 30, 20);
  images.AddSpot({-0.2, 0.1, 1.2}, {1.2, 0, 0.6}, {9, 6, 3}, 30, 20);
  images.AddSpot({2.6, 0.1, 1.2}, {1.2, 0, 0.6}, {9, 6, 3}, 30, 20);
  CheckCaustic(mirror, images);
}

TEST_CASE("splats: a distant light's caustic of a plane mirror is that of its image",
          "[light_paths]") {
  SceneBuilder mirror = FloorWith(true), images = FloorWith(false);
  mirror.AddDistant({-0.5, 0.1, 0.9}, {3, 2, 1});
  images.AddDistant({-0.5, 0.1, 0.9}, {3, 2, 1});
  images.AddDistant({0.5, 0.1, 0.9}, {3, 2, 1});
  CheckCaustic(mirror, images);
}

TEST_CASE("splats: light that misses the scene changes nothing", "[light_paths]") {
  SceneBuilder b = Corner();
  b.AddSpot({0, 0, 3}, {0, 0, 4}, Grey(5), 20, 5);
  const auto image = EstimateWith(b.Build(), "points=sobol,light-paths=splats:1", 64, 1);
  for (const Rgb& pixel : image.mean) CHECK(pixel == Rgb{});
}

}  // namespace lanelight::test
