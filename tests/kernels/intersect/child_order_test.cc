// The tables that bring the children that a ray enters in its order (child_order.h).
#include <bit>
#include <catch2/catch.hpp>
#include <vector>

#include "kernels/intersect/child_order.h"

namespace lanelight {
namespace {

// The lanes of `set` by the rule itself: lane 0 ^ octant is visited first, and what is
// visited first comes last.
std::vector<std::uint32_t> LastFirst(int lanes, std::uint32_t octant, std::uint32_t set) {
  std::vector<std::uint32_t> order;
  for (int k = lanes - 1; k >= 0; --k) {
    const std::uint32_t lane = static_cast<std::uint32_t>(k) ^ octant;
    if (set >> lane & 1) order.push_back(lane);
  }
  return order;
}

TEST_CASE("the table of 8 lanes lists the entered children, nearest last",
          "[intersect]") {
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    for (std::uint32_t set = 0; set < 256; ++set) {
      const auto expected = LastFirst(8, octant, set);
      REQUIRE(expected.size() == static_cast<std::size_t>(std::popcount(set)));
      for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK((kChildOrder8[octant][set] >> (4 * i) & 15) == expected[i]);
      }
    }
  }
}

TEST_CASE("the shuffles of 4 lanes move whole words in the same order", "[intersect]") {
  for (std::uint32_t octant = 0; octant < 4; ++octant) {
    for (std::uint32_t set = 0; set < 16; ++set) {
      const auto expected = LastFirst(4, octant, set);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        for (std::uint32_t b = 0; b < 4; ++b) {
          CHECK(kChildBytes4[octant][set].byte[4 * i + b] == 4 * expected[i] + b);
        }
      }
    }
  }
}

}  // namespace
}  // namespace lanelight
