// Group sizes of the samplers for any number of samples, and what is said about them.
#include <bit>
#include <catch2/catch.hpp>

#include "src/core/check.h"
#include "src/prepare/groups.h"
#include "src/prepare/parameters.h"
#include "tests/points/draw.h"

namespace lanelight::test {
namespace {

std::string TextOf(Points points, std::uint64_t spp, bool pairs = false) {
  Strategy strategy;
  strategy.points = points;
  if (pairs) strategy.pairs = Pairs::kAntithetic;
  return PointsText(strategy, spp);
}

}  // namespace

TEST_CASE("groups fit four times into any number of samples", "[points]") {
  for (Points points : kAllPoints) {
    for (std::uint64_t spp :
         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3},
          std::uint64_t{5}, std::uint64_t{7}, std::uint64_t{8}, std::uint64_t{10},
          std::uint64_t{100}, std::uint64_t{1000}, std::uint64_t{12345},
          std::uint64_t{1} << 31, ~std::uint64_t{0}}) {
      const std::uint32_t size = PointsGroupSize(points, spp);
      INFO(Name(points) << ", " << spp << " samples: groups of " << size);
      CHECK(size >= 1);
      CHECK(size <= MostGroupSize(points));
      if (spp > 0) CHECK((size == 1 || spp / size >= 4));
      const PointsParameters p = MakePointsParameters(points, size);
      CHECK(p.group_size == size);
      if (points == Points::kStratified || points == Points::kCmj) {
        CHECK(p.columns.count * p.rows.count == size);
        CHECK(p.rows.count <= 4 * p.columns.count);
        CHECK(p.rows.count >= p.columns.count);
      }
      CHECK_NOTHROW(TextOf(points, spp));
      CHECK_NOTHROW(TextOf(points, spp, true));
    }
  }
  CHECK(PointsGroupSize(Points::kIndependent, 1000) == 1);
  CHECK(PointsGroupSize(Points::kStratified, 1000) == 250);
  CHECK(PointsGroupSize(Points::kPmj02, 1000) == 128);
  CHECK(PointsGroupSize(Points::kPmj02, 1 << 20) == 1024);
  CHECK(PointsGroupSize(Points::kHalton, 864) == 216);
  CHECK(PointsGroupSize(Points::kLattice, 1000) == 250);
}

TEST_CASE("what a number of samples costs is said", "[points]") {
  using Catch::Contains;
  CHECK(TextOf(Points::kIndependent, 7) == "independent");
  CHECK(TextOf(Points::kStratified, 64) ==
        "stratified, 4 randomisations of 16 samples in 4x4 strata");
  CHECK_THAT(TextOf(Points::kStratified, 100), Contains("5x5 strata"));
  CHECK_THAT(TextOf(Points::kSobol, 100),
             Contains("6 randomisations of 16 samples") && Contains("4 left over"));
  CHECK_THAT(TextOf(Points::kStratified, 1009), Contains("left over"));
  CHECK_THAT(TextOf(Points::kCmj, 7), Contains("as independent"));
  CHECK_THAT(TextOf(Points::kPmj02, 1 << 20), Contains("1024 being the most"));
  CHECK_THAT(TextOf(Points::kSobol, 0), Contains("randomisations of 64 samples"));
  CHECK_THAT(TextOf(Points::kStratified, 128, true),
             Contains("of 32 samples in 4x4 strata") && Contains("antithetic"));
}

TEST_CASE("groups that a sampler does not have are mistakes", "[points]") {
  CHECK_THROWS_AS(MakePointsParameters(Points::kSobol, 12), CheckFailure);
  CHECK_THROWS_AS(MakePointsParameters(Points::kPmj02, 2048), CheckFailure);
  CHECK_THROWS_AS(MakePointsParameters(Points::kIndependent, 2), CheckFailure);
  CHECK_THROWS_AS(MakePointsParameters(Points::kLattice, 0), CheckFailure);
}

}  // namespace lanelight::test
