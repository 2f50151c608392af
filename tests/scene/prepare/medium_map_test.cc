// Media at points, found by the surfaces that bound them, and the media in which light
// subpaths start.
#include "src/scene/prepare/medium_map.h"

#include <catch2/catch.hpp>

#include "src/scene/prepare/light_media.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/kernels/media/scenes.h"

namespace lanelight::test {
namespace {

using Media = std::vector<std::int32_t>;
constexpr std::int32_t kUnclear = MediumMap::kUnclear;

// The index of a medium in the file order, by its sigma_s: 1 = {1, 1, 1}, and so on.
std::int32_t Number(const CompiledScene& scene, std::int32_t medium) {
  if (medium < 0) return medium;
  return static_cast<std::int32_t>(std::lround(
      double(scene.media.media[std::size_t(medium)].sigma_s[0]) * scene.scale));
}

Medium Of(double number) { return MakeMedium(Grey(0), Grey(number)); }

Media At(const PreparedScene& scene, std::initializer_list<Vec3d> points) {
  MediumMap map(*scene.compiled);
  CHECK(map.IsConsistent());
  Media found;
  for (const Vec3d& p : points) {
    const Vec3d local = (p - scene.compiled->center) * scene.compiled->scale;
    found.push_back(Number(*scene.compiled, map.At(local)));
  }
  return found;
}

// Media by light, before and behind it; without a start, kUnclear.
Media MediaOfLights(const SceneDescription& description) {
  const PreparedScene scene = PrepareScene(description);
  std::vector<double> weights(scene.compiled->lights.lights.size(), 1.0);
  const auto media = FindLightMedia(*scene.compiled, weights);
  Media found;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    for (const std::size_t side : {1, 0}) {
      found.push_back(weights[i] == 0 ? kUnclear
                      : media.empty() ? -3
                                      : Number(*scene.compiled, media[2 * i + side]));
    }
  }
  return found;
}

SceneBuilder Start() {
  SceneBuilder b(4, 4);
  b.Perspective({0, -9, 0}, {0, 0, 0}, {0, 0, 1}, 40);
  b.AddSphere({7, 0, 0}, 0.5, b.AddDiffuse(Grey(0.5)));
  return b;
}

}  // namespace

TEST_CASE("a medium map knows shapes in shapes", "[media]") {
  SceneBuilder b = Start();
  const Index outer = AddMedium(b, Of(1)), inner = AddMedium(b, Of(2));
  const Index interface = AddInterface(b);
  b.AddBox({-2, -2, -2}, {2, 2, 2}, interface);
  Bound(b, outer, kNone);
  b.AddSphere({0, 0, 0}, 1, interface);
  Bound(b, inner, outer);
  const std::initializer_list<Vec3d> points = {
      {0, 0, 0}, {0.9, 0, 0.1}, {1.5, 0, 0}, {-1.9, 1.9, 1.9}, {3, 0, 0}, {0, -9, 0}};
  CHECK(At(PrepareScene(b.Build()), points) == Media{2, 2, 1, 1, -1, -1});
  for (Shape& shape : b.scene().shapes) {
    shape.reverse_orientation = !shape.reverse_orientation;
    std::swap(shape.media.inside, shape.media.outside);
  }
  CHECK(At(PrepareScene(b.Build()), points) == Media{2, 2, 1, 1, -1, -1});
}

TEST_CASE("a medium map knows planes, disks and large spheres", "[media]") {
  SceneBuilder b = Start();
  const Index water = AddMedium(b, Of(3)), air = AddMedium(b, Of(4));
  b.AddPlane({0, 0, -1}, {0, 0, 1}, AddInterface(b));
  Bound(b, water, air);
  b.scene().camera.medium = air;
  CHECK(At(PrepareScene(b.Build()), {{0, 0, 0}, {0, 0, -2}}) == Media{4, 3});
  b.scene().shapes.pop_back();
  b.AddSphere({0, 0, -1e6 - 1}, 1e6, AddInterface(b));
  Bound(b, water, air);
  CHECK(At(PrepareScene(b.Build()), {{0, 0, 0}, {0, 0, -2}}) == Media{4, 3});
  b.scene().shapes.pop_back();
  // Rays pass beside a disk into the other half.
  b.AddDisk({0, 0, -1}, {0, 0, 1}, 1e4, AddInterface(b));
  Bound(b, water, air);
  CHECK(At(PrepareScene(b.Build()), {{0, 0, 0}, {0, 0, -2}}) == Media{4, 3});
}

TEST_CASE("a medium map knows instances and vertex normals", "[media]") {
  const char* scene = R"(
Camera "perspective"
MakeNamedMedium "smoke" "string type" "homogeneous" "rgb sigma_s" [ 5 5 5 ]
WorldBegin
LightSource "point"
ObjectBegin "ball"
  MediumInterface "smoke" ""
  Material "interface"
  Shape "trianglemesh" "point3 P" [ 1 0 0  0 1 0  0 0 1  -1 -1 -1 ]
    "normal N" [ 1 0 0  0 1 0  0 0 1  -1 -1 -1 ]
    "integer indices" [ 0 1 2  0 3 1  1 3 2  2 3 0 ]
ObjectEnd
AttributeBegin
  Translate 0 0 5
  ObjectInstance "ball"
AttributeEnd
AttributeBegin
  Translate 6 0 5
  Scale -2 2 2
  ObjectInstance "ball"
AttributeEnd
)";
  for (const std::uint64_t copied : {0, 100}) {
    CompileOptions options;
    options.copied_triangles = copied;
    const PreparedScene prepared =
        PrepareScene(ParseSceneText(scene, "test.pbrt", "."), options);
    CHECK(prepared.compiled->geometry.instances.size() == (copied > 0 ? 0u : 2u));
    CHECK(At(prepared, {{0, 0, 5}, {6, 0, 5}, {5, 0.1, 5.1}, {3, 0, 5}, {0, 0, 0}}) ==
          Media{5, 5, 5, -1, -1});
  }
}

TEST_CASE("a medium map finds media that contradict each other", "[media]") {
  SceneBuilder b = Start();
  const Index fog = AddMedium(b, Of(1));
  const Index interface = AddInterface(b);
  b.AddSphere({0, 0, 0}, 2, interface);
  Bound(b, fog, kNone);
  b.AddSphere({0, 0, 0}, 20, interface);
  Bound(b, fog, kNone);
  CHECK_FALSE(MediumMap(*PrepareScene(b.Build()).compiled).IsConsistent());
  b.scene().camera.medium = fog;
  // Rays from the camera miss the small sphere, which states vacuum around it.
  b.AddPoint({0, 0, 0}, Grey(1));
  CHECK(MediaOfLights(b.Build()) == Media{kUnclear, kUnclear});
}

TEST_CASE("light subpaths start in the media around lights", "[media][light_paths]") {
  SceneBuilder b = Start();
  const Index smoke = AddMedium(b, Of(1)), interface = AddInterface(b);
  const Index black = b.AddDiffuse(Grey(0));
  const Index one = b.AddEmission(Grey(1)), both = b.AddEmission(Grey(1), true);
  b.AddSphere({0, 0, 0}, 2, interface);
  Bound(b, smoke, kNone);
  b.AddQuad({0.1, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, black, both);  // in it
  b.AddQuad({1.9, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, black, one);   // through its bounds
  b.AddSphere({0, 0, 4}, 0.5, black, one);                        // beside it
  b.AddDisk({0, 0, -1}, {0, 0, 1}, 0.3, black, one);              // in it
  b.AddPoint({0, 0.2, 0}, Grey(1));
  b.AddEnvironment(Grey(1));
  CHECK(MediaOfLights(b.Build()) ==
        Media{1, 1, kUnclear, kUnclear, -1, -1, 1, -1, 1, -1, -1, -1});
}

TEST_CASE("light subpaths start on both sides of a surface between media",
          "[media][light_paths]") {
  SceneBuilder b = Start();
  const Index smoke = AddMedium(b, Of(1));
  for (const bool inward : {false, true}) {
    SceneBuilder ball = b;
    ball.AddSphere({0, 0, 0}, 2, ball.AddDiffuse(Grey(0)),
                   ball.AddEmission(Grey(1), true));
    Bound(ball, inward ? kNone : smoke, inward ? smoke : kNone);
    ball.scene().shapes.back().reverse_orientation = inward;
    CHECK(MediaOfLights(ball.Build()) == (inward ? Media{1, -1} : Media{-1, 1}));
  }
}

TEST_CASE("no light subpath starts at infinity behind an endless medium",
          "[media][light_paths]") {
  SceneBuilder b = Start();
  b.AddEnvironment(Grey(1));
  b.AddPoint({0, 0, 0}, Grey(1));
  b.scene().camera.medium = AddMedium(b, Of(1));
  CHECK(MediaOfLights(b.Build()) == Media{kUnclear, kUnclear, -3, -3});
  b.AddSphere({0, -9, 0}, 1, AddInterface(b));  // a bubble around the camera
  Bound(b, kNone, b.scene().camera.medium);
  b.scene().camera.medium = kNone;
  CHECK(MediaOfLights(b.Build()) == Media{kUnclear, kUnclear, 1, -1});
}

}  // namespace lanelight::test
