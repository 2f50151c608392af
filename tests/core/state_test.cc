#include "src/core/state.h"

#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "src/core/error.h"

namespace lanelight {

TEST_CASE("state: values come back as they were", "[state]") {
  const std::vector<double> numbers = {1.5, -0.0, 1e-310};
  StateWriter writer;
  writer.Write("count", std::uint32_t{7});
  writer.Write("numbers", numbers.data(), numbers.size());
  writer.Write("nothing", numbers.data(), 0);
  StateReader reader(writer.bytes());
  CHECK(reader.Read<std::uint32_t>("count") == 7);
  std::vector<double> back(3);
  reader.Read("numbers", back.data(), back.size());
  CHECK(back == numbers);
  CHECK(std::signbit(back[1]));
  CHECK_FALSE(reader.done());
  reader.Read("nothing", back.data(), 0);
  CHECK(reader.done());
}

TEST_CASE("state: what is not meant is refused", "[state]") {
  StateWriter writer;
  writer.Write("count", std::uint32_t{7});
  const std::string bytes = writer.bytes();
  CHECK_THROWS_AS(StateReader(bytes).Read<std::uint32_t>("size"), InputError);
  CHECK_THROWS_AS(StateReader(bytes).Read<std::uint64_t>("count"), InputError);
  std::array<std::uint32_t, 2> two;
  CHECK_THROWS_AS(StateReader(bytes).Read("count", two.data(), 2), InputError);
  CHECK_THROWS_AS(StateReader(bytes).Expect("count", std::uint32_t{8}), InputError);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    CHECK_THROWS_AS(StateReader(std::string_view(bytes).substr(0, length))
                        .Read<std::uint32_t>("count"),
                    InputError);
  }
  CHECK_NOTHROW(StateReader(bytes).Expect("count", std::uint32_t{7}));
}

}  // namespace lanelight
