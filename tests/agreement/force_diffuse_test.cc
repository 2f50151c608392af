// Option "forcediffuse": every material, made diffuse, against the reference, which
// samples its own materials; and what of the others is then left in the plan.
#include <catch2/catch.hpp>

#include "tests/agreement/agreement.h"
#include "tests/agreement/all_stages_scene.h"

namespace lanelight::test {
namespace {

SceneDescription Forced(SceneDescription scene) {
  scene.integrator.force_diffuse = true;
  return scene;
}

Plan PlanOf(const SceneDescription& description) {
  return MakePlan(PrepareScene(description, {}), {});
}

bool HasStage(const Plan& plan, const std::string& name) {
  return std::any_of(plan.paths().stages.begin(), plan.paths().stages.end(),
                     [&](const PlannedStage& s) { return s.stage.name == name; });
}

}  // namespace

TEST_CASE("forcediffuse: every material agrees with the reference", "[agreement]") {
  for (const Material& material : MaterialZoo()) {
    // Clear coats are in closed form, within 3 %.
    const bool coat = material.kind == MaterialKind::kCoatedDiffuse;
    stat::CheckSame(CompareWithReference(Forced(Plate(material, 6)), 2048, 1500,
                                         coat ? 0.03 : kFloatTolerance),
                    0.2, material.name);
  }
}

TEST_CASE("forcediffuse: textures, mixes and bump maps are evaluated first",
          "[agreement]") {
  SceneDescription scene = ParseSceneText(kForcedScene, "test.pbrt", ".");
  scene.film.width = scene.film.height = 8;
  CheckAgreement(scene, 8192, 3000, 0.05);
}

TEST_CASE("forcediffuse: a metal keeps its colour and loses its specular reflection",
          "[agreement]") {
  const SceneDescription scene = [] {
    SceneBuilder b(6, 6);
    b.Depth(2).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
    b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}));
    b.AddEnvironment({1, 1, 1});
    return b.Build();
  }();
  // Under an even sky both look the same: reflectance times its radiance.
  const Rgb mirror = ImageMean(RenderDescription(scene, {}).film);
  TestRender many;
  many.spp = 1024;
  const Rendered even = RenderDescription(Forced(scene), many);
  const Rgb mean = ImageMean(even.film), error = ImageStandardError(even.film);
  for (int c = 0; c < 3; ++c) {
    CHECK(std::abs(mean[c] - mirror[c]) < 5 * error[c] + 1e-4 * mirror[c]);
  }
  CHECK(mirror.x > mirror.y + 0.1);

  CHECK(HasStage(PlanOf(Forced(scene)), "shade_diffuse"));
  CHECK_FALSE(HasStage(PlanOf(scene), "shade_diffuse"));
}

TEST_CASE("forcediffuse: only one kind of material remains", "[plan]") {
  SceneDescription scene = ParseSceneText(kForcedScene, "test.pbrt", ".");
  const Plan forced = PlanOf(scene);
  CHECK(HasStage(forced, "force_diffuse"));
  for (const char* name : {"shade_coated_diffuse_rough", "shade_coated_conductor",
                           "shade_dielectric_rough"}) {
    CHECK_FALSE(HasStage(forced, name));
  }
  CHECK_FALSE(forced.features.HasAny({Feature::kRefraction}));
  scene.integrator.force_diffuse = false;
  const Plan own = PlanOf(scene);
  CHECK_FALSE(HasStage(own, "force_diffuse"));
  CHECK(HasStage(own, "shade_coated_conductor"));
}

}  // namespace lanelight::test
