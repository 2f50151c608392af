// Lists the differences of two strategies.
#include "src/base/core/source_location.h"
#include "src/vocabulary/strategy/strategy_text.h"

#include <catch2/catch.hpp>

#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

TEST_CASE("exactly the choices that differ are printed", "[strategy]") {
  Strategy other;
  ApplyStrategy("roulette=adjoint,reuse=block:32", {}, other);
  const std::string defaults = ToText({}), changed = ToText(other);
  CHECK(ChoicesNotIn(defaults, changed) == "roulette=adjoint,reuse=block:32:random");
  CHECK(ChoicesNotIn(changed, defaults) == "roulette=throughput,reuse=none");
  CHECK(ChoicesNotIn(defaults, defaults).empty());
  // One choice may begin as another does.
  CHECK(ChoicesNotIn("a=bc", "a=b") == "a=b");
}

}  // namespace lanelight
