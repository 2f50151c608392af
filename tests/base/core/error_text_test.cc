
#include <catch2/catch.hpp>
#include <stdexcept>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"

namespace lanelight {

TEST_CASE("a message says \"error\" once", "[core]") {
  const InputError bare("no such thing");
  CHECK(WithPrefix(bare) == "error: no such thing");
  CHECK(WithoutPrefix(bare) == "no such thing");
  const InputError placed({std::make_shared<const std::string>("a.pbrt"), 3, 4}, "odd");
  CHECK(WithPrefix(placed) == "a.pbrt:3:4: error: odd");
  CHECK(WithoutPrefix(placed) == "a.pbrt:3:4: error: odd");
  const std::runtime_error other("nothing there");
  CHECK(WithPrefix(other) == "error: nothing there");
  CHECK(WithPrefix(std::runtime_error(WithPrefix(other))) == "error: nothing there");
  CHECK(WithoutPrefix(other) == "nothing there");
}

}  // namespace lanelight
