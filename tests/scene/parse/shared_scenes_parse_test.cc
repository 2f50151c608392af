// Every scene of the shared data parses, with what its README says is in it.
#include <catch2/catch.hpp>

#include <filesystem>

#include "src/scene/parse/parse.h"
#include "tests/support/shared_scenes.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

std::size_t Triangles(const SceneDescription& scene) {
  std::size_t triangles = 0;
  for (const Shape& shape : scene.shapes) {
    if (shape.kind == ShapeKind::kMesh) triangles += shape.mesh->indices.size() / 3;
  }
  return triangles;
}

TEST_CASE("the shared scenes parse", "[parse]") {
  if (!HaveSharedScenes()) return;
  int parsed = 0;
  for (const auto& entry : fs::directory_iterator(SharedScenes())) {
    for (const char* name : {"scene-v4.pbrt", "reference.pbrt"}) {
      const std::string path = (entry.path() / name).string();
      if (!fs::exists(path)) continue;
      CAPTURE(path);
      const SceneDescription scene = ParseScene(path);
      ++parsed;
      CHECK(scene.shapes.size() > 0);
      CHECK(scene.area_lights.size() + scene.lights.size() > 0);
      CHECK(scene.camera.world_from_camera.IsInvertible());
      for (const Shape& shape : scene.shapes) {
        REQUIRE(shape.material != kNone);
        REQUIRE((shape.kind != ShapeKind::kMesh || shape.mesh != nullptr));
      }
      if (std::string(name) != "reference.pbrt") continue;
      CHECK(scene.integrator.max_depth == 16);
      CHECK(scene.filter.kind == FilterKind::kBox);
      CHECK(scene.strategy.sampler == SampleSequence::kIndependent);
      CHECK(scene.sampler.spp == 64);
      CHECK(std::max(scene.film.width, scene.film.height) == 256);
    }
  }
  CHECK(parsed > 0);
  CHECK(parsed % 2 == 0);
}

TEST_CASE("shared scene details", "[parse]") {
  if (!HaveSharedScenes()) return;
  const std::string folder = SharedScenes();
  const SceneDescription box = ParseScene(folder + "/cornell-box/scene-v4.pbrt");
  CHECK(Triangles(box) == 36);
  CHECK(box.area_lights.size() == 1);
  CHECK(box.camera.fov == 19.5);
  CHECK(box.integrator.max_depth == 65);
  // The camera stands at z = 6.8, looking along -z.
  CHECK(box.camera.world_from_camera.Point({0, 0, 0}).z == Approx(6.8));
  CHECK(box.camera.world_from_camera.Vector({0, 0, 1}).z == Approx(-1));

  const SceneDescription mis = ParseScene(folder + "/veach-mis/reference.pbrt");
  std::size_t spheres = 0;
  for (const Shape& shape : mis.shapes) spheres += shape.kind == ShapeKind::kSphere;
  CHECK(spheres == 3);

  const SceneDescription coffee = ParseScene(folder + "/coffee/reference.pbrt");
  CHECK(coffee.materials[3].name == "Metal");
  CHECK(coffee.materials[3].eta.constant.x < 0.5);  // silver
  CHECK(coffee.materials[3].k.constant.x > 2);
}

}  // namespace
}  // namespace lanelight
