// Glossy second vertices serve all first ones of a block, each with what it would see:
// the mean is that of paths that serve their own pixels.
#include <catch2/catch.hpp>

#include "tests/kernels/reuse/same_light.h"

namespace lanelight::test {
namespace {

Material Plastic(double alpha) {
  Material plastic;
  plastic.kind = MaterialKind::kCoatedDiffuse;
  plastic.reflectance.constant = {0.7, 0.5, 0.6};
  plastic.uroughness.constant = plastic.vroughness.constant = alpha;
  plastic.remap_roughness = false;
  return plastic;
}

// Nearly all of what it reflects is by its coat.
Material Glaze(double alpha) {
  Material glaze = Plastic(alpha);
  glaze.reflectance.constant = Grey(0.05);
  glaze.interface_eta = 4;
  return glaze;
}

Material Metal(double u_alpha, double v_alpha) {
  Material metal;
  metal.kind = MaterialKind::kConductor;
  metal.eta.constant = {0.2, 0.9, 1.1};
  metal.k.constant = {3.9, 2.5, 2.2};
  metal.uroughness.constant = u_alpha;
  metal.vroughness.constant = v_alpha;
  metal.remap_roughness = false;
  return metal;
}

struct Named {
  std::string name;
  Material material;
  bool narrow = false;
};

// Narrow lobes are not shared, or with their bases alone.
std::vector<Named> GlossyMaterials() {
  return {{"smooth plastic", Plastic(0)},
          {"narrow plastic", Plastic(0.02), true},
          {"rough plastic", Plastic(0.3)},
          {"glaze", Glaze(0.4)},
          {"narrow metal", Metal(0.05, 0.05), true},
          {"rough metal", Metal(0.3, 0.3)},
          {"brushed metal", Metal(0.15, 0.5)}};
}

}  // namespace

TEST_CASE("glossy second vertices are evaluated towards each pixel", "[reuse]") {
  for (const Named& side : GlossyMaterials()) {
    INFO(side.name);
    ReuseScene room = WithSides(side.material, 4);
    room.spp = 4096;
    room.power = 0.03;
    for (const std::string directions : {"mis", "light", "bsdf"}) {
      // Light samples hardly find what narrow lobes reflect: a noise in which nothing
      // would be seen.
      if (side.narrow && directions == "light") continue;
      CheckSame(room, "points=sobol,directions=" + directions, "reuse=block:16");
    }
  }
}

TEST_CASE("glossy second vertices work with every proposal and roulette", "[reuse]") {
  for (const Named& side :
       {Named{"smooth plastic", Plastic(0)}, Named{"rough plastic", Plastic(0.3)},
        Named{"brushed metal", Metal(0.15, 0.5)}}) {
    INFO(side.name);
    ReuseScene room = WithSides(side.material, 5);
    room.spp = 4096;
    room.power = 0.05;
    for (const std::string with : {"directions=uniform", "directions=mis:balance",
                                   "light-candidates=resampled", "roulette=constant"}) {
      CheckSame(room, "points=sobol," + with, "reuse=block:32:compact");
    }
  }
}

TEST_CASE("columns of glossy second vertices exist only with them", "[reuse]") {
  TestRender options;
  options.strategy = "reuse=block";
  const auto stages = [&](const Material& side) {
    const Plan plan = RenderDescription(WithSides(side, 4).description, options).plan;
    CHECK(plan.features.Has(Feature::kReuse));
    std::size_t count = 0;
    for (const PhaseId id : {PhaseId::kTile, PhaseId::kBlock}) {
      const Phase* const phase = plan.Find(id);
      if (phase != nullptr) count += phase->stages.size();
    }
    return count;
  };
  Material diffuse;
  CHECK(stages(diffuse) == 3);
  CHECK(stages(Plastic(0.3)) == 5);
}

}  // namespace lanelight::test
