// Integrator parameter "regularize": rougher surfaces behind a bounce that is not
// specular, against the scalar reference; and what is left of it where no file asks.
#include <catch2/catch.hpp>

#include "src/render/plan/plan.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

// Mirrors, glass and a metal, smooth or nearly so, on a floor that scatters.
SceneDescription Polished(bool regularize) {
  SceneBuilder b(8, 8);
  b.Depth(5).Perspective({0, -4, 2.5}, {0, 0, 0.4}, {0, 0, 1}, 36);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse({0.6, 0.5, 0.4}));
  b.AddSphere({0.55, 0, 0.45}, 0.4, b.AddDielectric(1.5));
  const Index metal = b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.02);
  b.AddSphere({-0.6, 0.2, 0.4}, 0.4, metal);
  Material coated;
  coated.kind = MaterialKind::kCoatedConductor;
  coated.eta.constant = {0.2, 0.9, 1.1};
  coated.k.constant = {3.9, 2.5, 2.2};
  coated.remap_roughness = false;
  coated.conductor_uroughness.constant = coated.conductor_vroughness.constant = 0.1;
  b.AddSphere({0, -0.7, 0.25}, 0.25, b.AddMaterial(coated));
  Texture cells;
  cells.kind = TextureKind::kCheckerboard;
  cells.is_float = true;
  cells.mapping = {6, 6, 0, 0};
  cells.tex1.constant = Grey(0.2), cells.tex2.constant = Grey(0.004);
  b.scene().textures.push_back(cells);
  Material glaze;
  glaze.kind = MaterialKind::kDielectric;
  glaze.interface_eta = 1.5;
  glaze.uroughness.texture = glaze.vroughness.texture = 0;
  b.AddSphere({0, 0.7, 0.3}, 0.3, b.AddMaterial(glaze));
  const Index lamp = b.AddEmission({6, 5, 4});
  b.AddQuad({-0.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}, b.AddDiffuse(Grey(0)), lamp);
  b.AddEnvironment({0.3, 0.3, 0.4});
  b.scene().integrator.regularize = regularize;
  return b.Build();
}

Plan RegularPlanOf(const SceneDescription& description) {
  return MakePlan(PrepareScene(description, {}), {});
}

bool HasRegularStage(const Plan& plan) {
  return std::any_of(
      plan.paths().stages.begin(), plan.paths().stages.end(),
      [](const PlannedStage& s) { return std::string(s.stage.name) == "regularize"; });
}

}  // namespace

TEST_CASE("regularize: every material agrees with the reference", "[agreement]") {
  CheckAgreement(Polished(true), 8192, 3000, 0.15);
}

TEST_CASE("regularize: strategies agree with each other", "[agreement]") {
  const SceneDescription scene = Polished(true);
  const auto plain = RenderWavefront(scene, 8192, "reuse=none");
  for (const char* strategy : {"reuse=block", "directions=light", "roulette=none"}) {
    const auto other = RenderWavefront(scene, 8192, strategy);
    stat::CheckSame(stat::CompareMeans(plain, other, {4, 1e-6, kFloatTolerance, 1e-7}),
                    strategy);
  }
}

TEST_CASE("regularize: leaving it out is detected", "[agreement]") {
  const SceneDescription regular = Polished(true), plain = Polished(false);
  const auto result = stat::CompareMeans(RenderWavefront(plain, 1 << 15),
                                         RenderWavefront(regular, 1 << 15),
                                         {4, 1e-6, kFloatTolerance, 1e-7});
  INFO(result.ToString());
  CHECK_FALSE(result.same);
}

TEST_CASE("regularize: scenes without it have no stages for it", "[agreement][plan]") {
  const Plan regular = RegularPlanOf(Polished(true)),
             plain = RegularPlanOf(Polished(false));
  CHECK(HasRegularStage(regular));
  CHECK_FALSE(HasRegularStage(plain));
  CHECK_FALSE(plain.features.Has(Feature::kRegularizes));
  // Nor where nothing has a roughness.
  SceneBuilder b(4, 4);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5)));
  b.AddEnvironment({1, 1, 1});
  b.scene().integrator.regularize = true;
  CHECK_FALSE(RegularPlanOf(b.Build()).features.Has(Feature::kRegularizes));
}

}  // namespace lanelight::test
