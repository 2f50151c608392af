// What a guide adds to a plan, and that it adds nothing where it has nothing to say.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include "tests/reference/scenes.h"
#include "tests/run/render_fixture.h"

namespace lanelight::test {
namespace {

Plan PlanOf(const SceneDescription& description, const std::string& strategy) {
  SceneDescription copy = description;
  ApplyStrategy(strategy, {}, copy.strategy);
  PlanOptions options;
  options.max_depth = static_cast<std::uint32_t>(description.integrator.max_depth);
  return MakePlan(PrepareScene(copy), options);
}

// Place of a stage in the order of execution; -1 = absent.
int Place(const Plan& plan, const std::string& name) {
  for (std::size_t i = 0; i < plan.stages.size(); ++i) {
    if (plan.stages[i].stage.name == name) return static_cast<int>(i);
  }
  return -1;
}

bool HasGuide(const Plan& plan) {
  const auto live = [&](Field field) {
    return std::find(plan.live_fields.begin(), plan.live_fields.end(), field) !=
           plan.live_fields.end();
  };
  CHECK(live(Field::u_guide) == live(Field::guide_cell));
  CHECK(live(Field::guide_pdf) == live(Field::guide_cell));
  CHECK((Place(plan, "guide") >= 0) == live(Field::guide_cell));
  return Place(plan, "guide") >= 0;
}

bool SaysNoEffect(const Plan& plan) {
  return std::any_of(plan.notes.begin(), plan.notes.end(), [](const std::string& note) {
    return note.find("guiding=radiance has no effect") != std::string::npos;
  });
}

SceneDescription Mirrors() {
  Material mirror;
  mirror.kind = MaterialKind::kConductor;
  mirror.uroughness.constant = mirror.vroughness.constant = 0;
  return Furnace(mirror, 3);
}

}  // namespace

TEST_CASE("guided plans: one stage more, before the surfaces are shaded", "[guide]") {
  const Plan plan = PlanOf(SmallRoom(), "guiding=radiance");
  REQUIRE(HasGuide(plan));
  CHECK(Place(plan, "guide") > Place(plan, "points_bounce_sobol"));
  CHECK(Place(plan, "guide") < Place(plan, "shade_diffuse"));
  CHECK_FALSE(SaysNoEffect(plan));
}

TEST_CASE("guided plans: no trace without guiding=radiance", "[guide]") {
  const Plan plan = PlanOf(SmallRoom(), "");
  CHECK_FALSE(HasGuide(plan));
  CHECK_FALSE(SaysNoEffect(plan));
  CHECK_FALSE(plan.features.Has(Feature::kGuided));
}

TEST_CASE("guided plans: nothing to guide is left as it is, and said", "[guide]") {
  for (const Plan& plan : {PlanOf(SmallRoom(), "guiding=radiance,directions=uniform"),
                           PlanOf(Mirrors(), "guiding=radiance"),
                           PlanOf(SmallRoom(16, 0), "guiding=radiance")}) {
    CHECK_FALSE(HasGuide(plan));
    CHECK(SaysNoEffect(plan));
  }
}

}  // namespace lanelight::test
