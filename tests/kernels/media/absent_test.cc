// Scenes without media have no column or stage for them.
#include <catch2/catch.hpp>
#include <algorithm>

#include "src/render/plan/plan.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/media/scenes.h"

namespace lanelight::test {
namespace {

Plan PlanOf(const SceneDescription& scene) { return MakePlan(PrepareScene(scene), {}); }

bool Runs(const Plan& plan, const std::string& stage) {
  return std::any_of(plan.paths().stages.begin(), plan.paths().stages.end(),
                     [&](const PlannedStage& s) { return stage == s.stage.name; });
}

bool HasColumn(const Plan& plan, Field field) {
  return std::find(plan.live_fields.begin(), plan.live_fields.end(), field) !=
         plan.live_fields.end();
}

constexpr const char* kStages[] = {
    "medium_distance", "medium_tracking", "interfaces",
    "media_dim",       "media_shadow",    "enter_media",
    "pass_interfaces", "vertices",        "shade_henyey_greenstein"};

}  // namespace

TEST_CASE("media: scenes without media have no stages for them", "[media][plan]") {
  const Plan plan = PlanOf(SmallRoom(8, 3));
  for (const char* stage : kStages) {
    INFO(stage);
    CHECK_FALSE(Runs(plan, stage));
  }
  CHECK_FALSE(HasColumn(plan, Field::medium));
  CHECK_FALSE(HasColumn(plan, Field::u_medium_0));
  CHECK_FALSE(HasColumn(plan, Field::odds_r));
  CHECK_FALSE(HasColumn(plan, Field::sh_o_x));
  CHECK(plan.ray_kernels.num_closest == 0);
  const CompiledScene scene = CompileScene(SmallRoom(8, 3), {});
  CHECK(scene.media.media.empty());
  CHECK(scene.media.primitives.empty());
}

TEST_CASE("media: fog alone needs no interfaces", "[media][plan]") {
  const Plan plan = PlanOf(Fog());
  CHECK(Runs(plan, "medium_distance"));
  CHECK(Runs(plan, "media_dim"));
  for (const char* stage : {"medium_tracking", "interfaces", "media_shadow",
                            "enter_media", "pass_interfaces"}) {
    INFO(stage);
    CHECK_FALSE(Runs(plan, stage));
  }
  CHECK_FALSE(HasColumn(plan, Field::passed));
  CHECK_FALSE(HasColumn(plan, Field::sh_o_x));
}

TEST_CASE("media: interfaces replace the opaque shadow rays", "[media][plan]") {
  const Plan plan = PlanOf(NestedClouds());
  CHECK(Runs(plan, "media_shadow"));
  CHECK_FALSE(Runs(plan, "shadow_spheres"));
  CHECK_FALSE(Runs(plan, "media_dim"));
  CHECK(plan.ray_kernels.num_closest == 3);  // triangles, spheres, the plane
  CHECK(plan.ray_kernels.num_surface == 3);
}

TEST_CASE("media: a medium without a boundary is left out", "[media][plan]") {
  SceneDescription scene = SmallRoom(8, 3);
  scene.media.push_back(MakeMedium({1, 1, 1}, {1, 1, 1}));
  CHECK_FALSE(PlanOf(scene).features.Has(Feature::kMedia));
  for (Shape& shape : scene.shapes) shape.media = {0, 0};  // no transition
  CHECK_FALSE(PlanOf(scene).features.Has(Feature::kMedia));
}

}  // namespace lanelight::test
