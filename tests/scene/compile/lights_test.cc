#include "src/scene/compile/lights.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "src/base/core/pi.h"
#include "src/scene/compile/compile.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/scene/compile/testing.h"

namespace lanelight {
namespace {

// The lit square of the tests: area 4, half diagonal sqrt 2, scale 1.
SceneDescription LitSquare(const AreaLight& light) {
  SceneDescription d = SquareScene();
  d.shapes[0].area_light = AddAreaLight(d, light);
  return d;
}

Light LightOf(LightKind kind, Rgb emission) {
  Light light;
  light.kind = kind;
  light.where = At(30);
  light.emission = emission;
  return light;
}

AlignedVector<float> PmfOf(const CompiledScene& scene) {
  return MakeLightChances(scene, {}).pmf;
}

// Probability of light i by enumerating the alias table.
double TablePmf(const LightChances& table, std::size_t i) {
  double p = 0;
  const double n = static_cast<double>(table.alias.size());
  for (std::size_t j = 0; j < table.alias.size(); ++j) {
    if (j == i) p += table.alias_q[j] / n;
    if (table.alias[j] == i) p += (1.0 - table.alias_q[j]) / n;
  }
  return p;
}

// Its right angles lost, so that it is no rectangle. Of the same area.
SceneDescription LitRhomboid(const AreaLight& light) {
  SceneDescription d = LitSquare(light);
  TriangleMesh mesh = *d.shapes[0].mesh;
  for (auto& p : mesh.positions) p.x += 0.5 * p.y;
  d.shapes[0].mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return d;
}

TEST_CASE("compile: an emitting mesh becomes one light per triangle",
          "[scene][compile]") {
  AreaLight light;
  light.radiance = {1, 2, 3};
  light.scale = 10;
  SceneDescription d = LitRhomboid(light);
  d.shapes.insert(d.shapes.begin(), MeshShape(Square(), 0));  // does not emit
  d.shapes[0].world_from_object = Transform::Translate({0, 0, 0.5});
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.lights.lights.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const LightRecord& r = scene.lights.lights[i];
    CHECK(r.shape == static_cast<std::uint32_t>(LightShape::kTriangle));
    CHECK(ToVec(r.radiance) == Vec3d{10, 20, 30});
    CHECK(r.area == Approx(2 * scene.scale * scene.scale));
    CHECK(PmfOf(scene)[i] == 0.5f);
    CHECK(r.primitive == 2 + i);
    CHECK(r.two_sided == 0);
    CHECK(r.environment == -1);
    CHECK(scene.geometry.triangles[2 + i].light == static_cast<int>(i));
    CHECK(scene.geometry.triangles[i].light == -1);
  }
  CHECK(scene.features.HasAll({Feature::kAreaLights, Feature::kTriangleLights,
                               Feature::kLights, Feature::kManyLights, Feature::kMis}));
}

TEST_CASE("compile: power of area lights", "[scene][compile]") {
  AreaLight light;
  light.radiance = {2, 2, 2};
  light.scale = 5;
  light.power = 100;
  for (double size : {1.0, 1e-4, 300.0}) {
    for (bool two_sided : {false, true}) {
      light.two_sided = two_sided;
      SceneDescription d = LitSquare(light);
      d.shapes[0].world_from_object = Transform::Scale({size, size, size});
      const CompiledScene scene = CompileScene(d);
      // The area of each triangle.
      const double area = 2 * size * size, sides = two_sided ? 2 : 1;
      CHECK(scene.lights.lights[0].radiance[1] ==
            Approx(10 * 100 / (kPi * area * sides)));
      CHECK(scene.lights.lights[0].two_sided == (two_sided ? 1u : 0u));
    }
  }
}

TEST_CASE("compile: emitting spheres and disks", "[scene][compile]") {
  SceneDescription d = SquareScene();
  AreaLight light;
  d.shapes = {SphereShape(1, 0), DiskShape(1, 0), SphereShape(0.5, 0)};
  d.shapes[1].inner_radius = 0.5;
  d.shapes[1].world_from_object = Transform::Translate({0, 0, 0.5});
  d.shapes[0].area_light = AddAreaLight(d, light);
  light.two_sided = true;
  d.shapes[1].area_light = AddAreaLight(d, light);
  const CompiledScene scene = CompileScene(d);
  const double s2 = scene.scale * scene.scale;
  REQUIRE(scene.lights.lights.size() == 2);
  const LightRecord& sphere = scene.lights.lights[0];
  const LightRecord& disk = scene.lights.lights[1];
  CHECK(sphere.shape == static_cast<std::uint32_t>(LightShape::kSphere));
  CHECK(sphere.primitive == 0);
  CHECK(sphere.area == Approx(4 * kPi * s2));
  CHECK(disk.shape == static_cast<std::uint32_t>(LightShape::kDisk));
  CHECK(disk.primitive == 2);
  CHECK(disk.area == Approx(0.75 * kPi * s2));
  CHECK(scene.geometry.spheres[0].light == 0);
  CHECK(scene.geometry.spheres[1].light == -1);
  CHECK(scene.geometry.disks[0].light == 1);
  // Powers 4 : 0.75 * 2.
  CHECK(PmfOf(scene)[0] == Approx(4 / 5.5));
  CHECK(PmfOf(scene)[1] == Approx(1.5 / 5.5));
}

TEST_CASE("compile: very small emitters keep their power", "[scene][compile]") {
  // A light of 2e-6 beside things of size 1: float32 coordinates round its corners.
  AreaLight light;
  light.radiance = {1e9, 1e9, 1e9};
  SceneDescription d = LitSquare(light);
  const double size = 1.1e-6;
  d.shapes[0].world_from_object = Transform::Translate({0.7, 0.6, 0.5}) *
                                  Transform::Rotate(33, {1, 2, 3}) *
                                  Transform::Scale({size, size, size});
  d.shapes.push_back(MeshShape(Square(), 0));
  const CompiledScene scene = CompileScene(d);
  double power = 0, areas = 0;
  for (const LightRecord& r : scene.lights.lights) {
    power += double(r.radiance[0]) * r.area;
    areas += r.area;
  }
  const double exact = 4 * size * size * scene.scale * scene.scale;
  CHECK(power == Approx(1e9 * exact).epsilon(1e-6));
  CHECK(std::abs(areas / exact - 1) > 1e-3);  // what rounding did to the area
}

TEST_CASE("compile: point, spot and distant lights", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.shapes[0].world_from_object = Transform::Scale({8, 8, 8});  // scale 1/8
  Light point = LightOf(LightKind::kPoint, {64, 64, 64});
  point.from = {0, 0, 8};
  Light spot = LightOf(LightKind::kSpot, {128, 128, 128});
  spot.from = {1, 0, 0};
  spot.to = {1, 0, 5};
  spot.cone_angle = 60;
  spot.cone_delta = 15;
  spot.world_from_light = Transform::Rotate(-90, {1, 0, 0}) * Transform::Scale({2, 2, 2});
  Light distant = LightOf(LightKind::kDistant, {3, 3, 3});
  distant.from = {0, 0, 10};
  distant.to = {0, 0, 4};
  distant.world_from_light = Transform::Rotate(90, {0, 1, 0});
  d.lights = {point, spot, distant};
  const CompiledScene scene = CompileScene(d);
  CHECK(scene.scale == 0.125);
  REQUIRE(scene.lights.lights.size() == 3);
  const auto& lights = scene.lights.lights;
  CHECK(lights[0].radiance[0] == 1);  // 64 / 8^2
  CHECK(ToVec(lights[0].position) == Vec3d{0, 0, 1});
  CHECK(lights[1].radiance[0] == 2);
  CHECK(Length(ToVec(lights[1].position) - Vec3d{0.25, 0, 0}) < 1e-6);
  CHECK(Length(ToVec(lights[1].direction) - Vec3d{0, 1, 0}) < 1e-6);
  CHECK(lights[1].versine_total == Approx(0.5));
  CHECK(lights[1].versine_falloff == Approx(1 - std::sqrt(0.5)));
  CHECK(lights[2].radiance[0] == 3);
  CHECK(Length(ToVec(lights[2].direction) - Vec3d{1, 0, 0}) < 1e-6);  // toward the light
  // Powers: 4 pi; 2 pi 2 (1 - (cos 45 + cos 60) / 2); pi R^2 3 with R^2 = 2.
  const double power[3] = {4 * kPi, 4 * kPi * (1 - (std::sqrt(0.5) + 0.5) / 2), 6 * kPi};
  for (int i = 0; i < 3; ++i) {
    CHECK(PmfOf(scene)[static_cast<std::size_t>(i)] ==
          Approx(power[i] / (power[0] + power[1] + power[2])));
  }
  CHECK(scene.features.HasAll(
      {Feature::kPointLights, Feature::kSpotLights, Feature::kDistantLights}));
  // None of them can be hit.
  CHECK_FALSE(scene.features.HasAny(
      {Feature::kMis, Feature::kAreaLights, Feature::kInfiniteLights}));
}

TEST_CASE("compile: constant environment", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.lights = {LightOf(LightKind::kInfinite, {0.5, 0.5, 0.5})};
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.lights.lights.size() == 1);
  CHECK(scene.lights.lights[0].radiance[2] == 0.5f);
  CHECK(PmfOf(scene)[0] == 1);
  CHECK(scene.lights.infinite == std::vector<std::uint32_t>{0});
  CHECK(scene.lights.environments.empty());
  CHECK(scene.features.HasAll(
      {Feature::kInfiniteConstant, Feature::kInfiniteLights, Feature::kMis}));
  CHECK_FALSE(scene.features.Has(Feature::kManyLights));
}

TEST_CASE("compile: lights without radiance are left out", "[scene][compile]") {
  AreaLight dark;
  dark.scale = 0;
  SceneDescription d = LitSquare(dark);
  d.lights = {LightOf(LightKind::kPoint, {0, 0, 0}), LightOf(LightKind::kInfinite, {}),
              LightOf(LightKind::kPoint, {0, 1e-20, 0})};
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.lights.lights.size() == 1);
  CHECK(scene.geometry.triangles[0].light == -1);
  CHECK(scene.geometry.triangles.size() == 2);
  CHECK_FALSE(scene.features.Has(Feature::kAreaLights));
}

TEST_CASE("compile: selection follows power, with a floor", "[scene][compile]") {
  SceneDescription d = SquareScene();
  for (double power : {1.0, 3.0, 1e-12, 4.0}) {
    d.lights.push_back(LightOf(LightKind::kPoint, {power, power, power}));
  }
  const CompiledScene scene = CompileScene(d);
  const LightChances table = MakeLightChances(scene, {});
  const auto& pmf = table.pmf;
  CHECK(double(pmf[0]) + double(pmf[1]) + double(pmf[2]) + double(pmf[3]) == Approx(1));
  CHECK(pmf[0] == Approx(0.125).epsilon(1e-4));
  CHECK(pmf[1] == Approx(0.375).epsilon(1e-4));
  CHECK(pmf[2] >= 1e-6f);
  CHECK(pmf[2] < 1.1e-6f);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(TablePmf(table, i) == Approx(pmf[i]).epsilon(1e-7));
  }
  Strategy uniform;
  uniform.light_selection = LightSelection::kUniform;
  CHECK(MakeLightChances(scene, uniform).pmf == AlignedVector<float>(4, 0.25f));
}

TEST_CASE("compile: emitters in instances are sampled in the world", "[scene][compile]") {
  SceneDescription d = SquareScene();
  d.objects.resize(1);
  d.objects[0].shapes = {MeshShape(Square(), 0), MeshShape(Square(), 0)};
  d.objects[0].shapes[1].area_light = AddAreaLight(d, {});
  for (double z : {1.0, 2.0, 3.0}) {
    Instance instance;
    instance.object = 0;
    instance.world_from_object =
        Transform::Translate({0, 0, z}) * Transform::Scale({z, z, z});
    d.instances.push_back(instance);
  }
  const CompiledScene scene = CompileScene(d);
  REQUIRE(scene.lights.lights.size() == 3);
  CHECK(scene.geometry.instances.size() == 3);
  REQUIRE(scene.geometry.groups.size() == 2);
  CHECK(scene.geometry.groups[0].end == 2 + 6);
  CHECK(scene.geometry.groups[1].end == 2 + 6 + 2);  // the object keeps what is dark
  for (std::uint32_t i = 8; i < 10; ++i) CHECK(scene.geometry.triangles[i].light == -1);
  const LightRecord& last = scene.lights.lights[2];
  CHECK(last.area == Approx(36 * scene.scale * scene.scale));
  CHECK(Vertex(scene.geometry.triangles[last.primitive], 0).z ==
        Approx((3 - scene.center.z) * scene.scale));
}

TEST_CASE("compile: invalid lights are refused", "[scene][compile]") {
  SceneDescription d = SquareScene();
  AddAreaLight(d, {});
  SceneDescription plane = d;
  plane.shapes.push_back(PlaneShape(0));
  plane.shapes[1].area_light = 0;
  CHECK(CompileError(plane).find("scene.pbrt:13:1: error: an infinite plane") == 0);
  SceneDescription interface = d;
  interface.shapes[0].area_light = 0;
  interface.materials[0].kind = MaterialKind::kInterface;
  CHECK(CompileError(interface).find("\"interface\"") != std::string::npos);
  SceneDescription spot = d;
  spot.lights = {LightOf(LightKind::kSpot, {1, 1, 1})};
  spot.lights[0].to = {};
  CHECK(CompileError(spot).find("scene.pbrt:30:1: error: a spot light") == 0);
  spot.lights[0].kind = LightKind::kDistant;
  spot.lights[0].to = {};
  CHECK(CompileError(spot).find("a distant light") != std::string::npos);
}

}  // namespace
}  // namespace lanelight
