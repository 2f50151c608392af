// A SIMD target is found by its name, and an unknown one is refused with the legal names.
#include "kernels/simd/target.h"

#include <cctype>
#include <catch2/catch.hpp>
#include <set>

#include "src/base/core/error.h"

namespace lanelight {

TEST_CASE("every available SIMD target is found by its name", "[simd]") {
  const auto targets = AvailableTargets();
  REQUIRE_FALSE(targets.empty());
  std::set<std::size_t> places;
  for (const std::string& name : targets) {
    const SimdTarget target(name);
    CHECK(target.name() == name);
    CHECK(target.lanes() == (name == "AVX3" ? 16 : name == "AVX2" ? 8 : 4));
    CHECK(places.insert(target.table_index()).second);
  }
  CHECK(SimdTarget().name() == targets.front());
  CHECK(SimdTarget("") == SimdTarget());
  std::string small = targets.back();
  for (char& c : small)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  CHECK(SimdTarget(small) == SimdTarget(targets.back()));
}

TEST_CASE("an unknown SIMD target is refused", "[simd]") {
  CHECK_THROWS_WITH(SimdTarget("AVX9000"),
                    Catch::Contains("targets of this machine are"));
}

}  // namespace lanelight
