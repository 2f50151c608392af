// Control variates that the scene or the rest of the strategy leaves nothing to do.
#include <catch2/catch.hpp>

#include "tests/control/control_scenes.h"

namespace lanelight::test {

TEST_CASE("control variates that cannot work are refused", "[control]") {
  const auto message = [](const SceneDescription& scene, const std::string& strategy) {
    try {
      RenderWith(scene, strategy, 1);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  using Catch::Contains;
  const SceneDescription dark = Furnace(Lambert(Grey(0.5)), 2), room = SmallRoom(4);
  CHECK_THAT(message(dark, "control=analytic"),
             Contains("needs emitting shapes") && Contains("control=ambient"));
  CHECK_THAT(message(room, "control=ambient"),
             Contains("needs an environment") && Contains("control=analytic"));
  CHECK_THAT(message(room, "control=analytic,directions=bsdf"),
             Contains("directions=light or mis, not bsdf"));
  CHECK_THAT(message(SmallRoom(4, 0), "control=analytic"), Contains("maximum depth"));
  CHECK(message(SmallRoom(4, 0), "control=regression").empty());
  Material metal;
  metal.kind = MaterialKind::kConductor;
  metal.eta.constant = metal.k.constant = Grey(1);
  CHECK_THAT(message(Furnace(metal, 2), "control=ambient"), Contains("Lambertian"));
  CHECK(message(room, "control=regression").empty());
}

}  // namespace lanelight::test
