// The shared real scenes compile, and what comes out is sound.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/scene/compile/compile.h"
#include "src/scene/parse/parse.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/scene/compile/testing.h"
#include "tests/support/shared_scenes.h"

namespace lanelight {
namespace {

void CheckTriangles(const CompiledScene& scene) {
  const Geometry& g = scene.geometry;
  std::size_t bad = 0;
  for (std::size_t i = 0; i < g.triangles.size(); ++i) {
    const TriangleRecord& t = g.triangles[i];
    bad += t.material >= scene.materials.size();
    bad += t.light >= static_cast<int>(scene.lights.lights.size());
    const Vec3d n = FaceNormal(t);
    bad += !(std::abs(Length(n) - 1) < 1e-5);
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) bad += !(std::abs(t.p[k][axis]) <= 2);
      if (g.normals.empty()) continue;
      bad +=
          !(std::abs(Length(ToVec(&g.normals[9 * i + 3 * std::size_t(k)])) - 1) < 1e-5);
    }
  }
  CHECK(bad == 0);
}

void CheckLights(const CompiledScene& scene) {
  REQUIRE_FALSE(scene.lights.lights.empty());
  const AlignedVector<float> pmf = MakeLightChances(scene, {}).pmf;
  double sum = 0;
  for (std::size_t i = 0; i < scene.lights.lights.size(); ++i) {
    const LightRecord& light = scene.lights.lights[i];
    sum += pmf[i];
    CHECK(pmf[i] > 0);
    CHECK(std::isfinite(light.radiance[0] + light.radiance[1] + light.radiance[2]));
    const auto shape = static_cast<LightShape>(light.shape);
    if (shape != LightShape::kTriangle && shape != LightShape::kRectangle) continue;
    const auto& triangles = scene.geometry.triangles;
    CHECK(triangles[light.primitive].light == static_cast<int>(i));
    if (shape == LightShape::kTriangle) continue;
    CHECK(triangles[light.second_primitive].light == static_cast<int>(i));
  }
  CHECK(sum == Approx(1));
}

TEST_CASE("compile: the shared scenes", "[scene][compile]") {
  if (!HaveSharedScenes()) return;
  for (const char* name :
       {"cornell-box", "veach-mis", "veach-bidir", "material-testball"}) {
    const std::string path = SharedScenes() / name / "reference.pbrt";
    INFO(path);
    const CompiledScene scene = CompileScene(ParseScene(path));
    CHECK_FALSE(scene.geometry.triangles.empty());
    CheckTriangles(scene);
    CheckLights(scene);
  }
}

}  // namespace
}  // namespace lanelight
