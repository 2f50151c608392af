// Forcing a SIMD target takes effect, and an unknown one is refused with the legal names.
#include "kernels/simd/target.h"

#include <catch2/catch.hpp>

#include "src/core/error.h"

namespace lanelight {

TEST_CASE("every available SIMD target can be forced", "[simd]") {
  const auto targets = AvailableTargets();
  REQUIRE_FALSE(targets.empty());
  for (const std::string& name : targets) {
    ForceTarget(name);
    CHECK(CurrentTarget() == name);
    CHECK(AvailableTargets() == targets);
    CHECK(CurrentLanes() == (name == "AVX3" ? 16 : name == "AVX2" ? 8 : 4));
  }
  ForceTarget("");
  CHECK(CurrentTarget() == targets.front());
}

TEST_CASE("an unknown SIMD target is refused", "[simd]") {
  CHECK_THROWS_WITH(ForceTarget("AVX9000"), Catch::Contains("this machine can run"));
}

}  // namespace lanelight
