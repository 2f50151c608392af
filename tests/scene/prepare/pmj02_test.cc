// The stored pmj02 sequences: all elementary intervals of all prefixes, and the freedom
// that the construction leaves.
#include "src/scene/prepare/pmj02.h"

#include <catch2/catch.hpp>
#include <set>
#include <vector>

namespace lanelight {
namespace {

// One of the first 2^k points in each box of j digits of u0 and k - j of u1, for all j.
bool IsNet(std::span<const std::uint32_t> points, std::uint32_t k) {
  for (std::uint32_t j = 0; j <= k; ++j) {
    std::vector<bool> seen(std::size_t{1} << k);
    for (std::size_t i = 0; i < std::size_t{1} << k; ++i) {
      const std::uint64_t x = std::uint64_t{points[2 * i]} << j >> 32;
      const std::uint64_t y = std::uint64_t{points[2 * i + 1]} << (k - j) >> 32;
      const std::size_t box = static_cast<std::size_t>((x << (k - j)) + y);
      if (seen[box]) return false;
      seen[box] = true;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("every prefix of 2^k points of the table is a net", "[points]") {
  const auto table = Pmj02Table();
  constexpr std::size_t kNumbers = 2 * kPmj02SequenceLength;
  REQUIRE(table.size() == kNumbers * kPmj02Sequences);
  for (std::size_t s = 0; s < kPmj02Sequences; ++s) {
    for (std::uint32_t k = 0; k <= 10; ++k) {
      REQUIRE(IsNet(table.subspan(s * kNumbers, kNumbers), k));
    }
  }
  std::vector<std::uint32_t> broken(table.begin(), table.begin() + kNumbers);
  broken[600] ^= 1u << 31;
  CHECK_FALSE(IsNet(broken, 10));
}

TEST_CASE("other sizes and seeds give nets too, and different ones", "[points]") {
  std::set<std::vector<std::uint32_t>> leading;
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    std::vector<std::uint32_t> points(2 * 64);
    MakePmj02(seed, points);
    for (std::uint32_t k = 0; k <= 6; ++k) REQUIRE(IsNet(points, k));
    // The four leading digits of the first eight points.
    std::vector<std::uint32_t> digits;
    for (std::size_t i = 0; i < 16; ++i) digits.push_back(points[i] >> 28);
    leading.insert(digits);
  }
  CHECK(leading.size() > 60);
}

}  // namespace lanelight
