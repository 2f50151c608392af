// reuse=block has the mean of paths that serve their own pixels, with every roulette,
// proposal, layout and material. (tests/vocabulary/strategy/unbiased_test.cc compares it
// with the scalar reference.)
#include <catch2/catch.hpp>

#include "src/base/core/error.h"
#include "tests/kernels/reuse/same_light.h"

namespace lanelight::test {
namespace {

// A room that is seen by way of a mirror for a part, whose paths are cut at a depth.
ReuseScene& Room() {
  static ReuseScene room = {SmallRoom(8, 4, 0.3)};
  return room;
}

// Plastic, whose coat is a mirror.
ReuseScene PlasticSides() {
  Material plastic;
  plastic.kind = MaterialKind::kCoatedDiffuse;
  plastic.reflectance.constant = Grey(0.7);
  plastic.uroughness.constant = plastic.vroughness.constant = 0;
  return WithSides(plastic, 4);
}

// Mirrors, in which first vertices come an event later, with no suffix left.
ReuseScene MirrorSides() {
  Material mirror;
  mirror.kind = MaterialKind::kConductor;
  mirror.eta.constant = {0.2, 0.2, 0.2};
  mirror.k.constant = {3.9, 3.9, 3.9};
  mirror.uroughness.constant = mirror.vroughness.constant = 0;
  return WithSides(mirror, 2);
}

}  // namespace

TEST_CASE("roulette before the second vertex is unbiased", "[reuse]") {
  for (const char* roulette :
       {"roulette=none", "roulette=constant:0.25", "roulette=throughput:0:1",
        "roulette=throughput:0.05:1", "roulette=throughput"}) {
    CheckSame(Room(), std::string("points=sobol,") + roulette, "reuse=block:16");
  }
}

TEST_CASE("second vertices follow the density of each direction proposal", "[reuse]") {
  ReuseScene uniform = Room();
  uniform.power = 0.05;
  CheckSame(uniform, "points=sobol,directions=uniform", "reuse=block:8");
  CheckSame(uniform, "points=sobol,directions=bsdf", "reuse=block:8");
  CheckSame(Room(), "points=sobol,directions=light", "reuse=block:8");
  CheckSame(Room(), "points=sobol,light-candidates=resampled", "reuse=block:8");
}

TEST_CASE("path reuse is unbiased for every block layout and size", "[reuse]") {
  for (const char* reuse :
       {"reuse=block:2", "reuse=block:4:compact", "reuse=block:32", "reuse=block:64"}) {
    CheckSame(Room(), "points=sobol", reuse);
  }
  ReuseScene odd = {Room().description};
  odd.description.film.width = 7;
  odd.description.film.height = 7;
  CheckSame(odd, "points=sobol", "reuse=block:16");
}

TEST_CASE("path reuse is unbiased for every kind of material", "[reuse]") {
  for (const Material& material : MaterialZoo()) {
    INFO(material.name);
    ReuseScene plate = {Plate(material, 8, 3), 2048, 0.03};
    CheckSame(plate, "points=sobol", "reuse=block:16");
  }
  // A coin decides between the coat's mirror and uniform directions.
  ReuseScene sides = PlasticSides();
  CheckSame(sides, "points=sobol,directions=uniform", "reuse=block:16");
  CheckSame(sides, "points=sobol", "reuse=block:16");
}

TEST_CASE("first vertices seen in mirrors form their own blocks", "[reuse]") {
  ReuseScene sides = MirrorSides();
  CheckSame(sides, "points=sobol", "reuse=block:64");
}

TEST_CASE("settings that reuse=block does not support are refused", "[reuse]") {
  for (const char* other : {"roulette=adjoint", "control=regression"}) {
    INFO(other);
    CHECK_THROWS_AS(
        EstimateWith(Room().description, std::string("reuse=block,") + other, 4, 1),
        InputError);
  }
}

TEST_CASE("without reuse=block there are no stages or columns for it", "[reuse]") {
  TestRender options;
  const Plan none = RenderDescription(Room().description, options).plan;
  CHECK(none.Find(PhaseId::kTile) == nullptr);
  CHECK(none.Find(PhaseId::kBlock) == nullptr);
  CHECK_FALSE(none.features.Has(Feature::kReuse));
  for (const PlannedStage& planned : none.paths().stages) {
    CHECK(std::string(planned.stage.name).find("reuse") == std::string::npos);
  }
  for (const Field field : none.live_fields) CHECK(field != Field::reuse);
  options.strategy = "reuse=block";
  const Plan block = RenderDescription(Room().description, options).plan;
  CHECK(block.Find(PhaseId::kTile) == nullptr);
  CHECK(block.Find(PhaseId::kBlock)->stages.size() == 3);
  CHECK(block.bytes_per_path <= none.bytes_per_path + 12);
}

}  // namespace lanelight::test
