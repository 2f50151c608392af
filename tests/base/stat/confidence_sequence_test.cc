// Intervals that hold at all looks: against random walks.
#include "src/base/stat/hypothesis.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "tests/base/stat/simulate.h"

namespace lanelight::stat {

// 2000 random walks, looked at 90 times until they are 1e6 times as long. At 95 %, 100
// leave their intervals at most on average, and more than 139 with a probability of 1e-4.
TEST_CASE("a random walk stays inside at all looks with the stated probability",
          "[stat]") {
  reference::Random random(3);
  constexpr int kWalks = 2000;
  int left = 0, left_fixed = 0;
  const double fixed = NormalQuantile(0.975);
  for (int walk = 0; walk < kWalks; ++walk) {
    double variance = 0, sum = 0;
    bool inside = true, inside_fixed = true;
    for (double growth = 1; growth < 1e6; growth *= 1.17) {
      sum += std::sqrt(growth - variance) * Normal(random);
      variance = growth;
      const double z = std::abs(sum) / std::sqrt(variance);
      inside &= z <= TimeUniformQuantile(growth, 0.95);
      inside_fixed &= z <= fixed;
    }
    left += !inside;
    left_fixed += !inside_fixed;
  }
  INFO(left << " walks left, " << left_fixed << " those of one look");
  CHECK(left <= 139);
  CHECK(left_fixed > kWalks / 3);
}

TEST_CASE("time-uniform quantiles are wider than those of one look, and finite",
          "[stat]") {
  for (const double growth : {1.0, 2.0, 100.0, 1e12}) {
    const double q = TimeUniformQuantile(growth, 0.95);
    CHECK(q > NormalQuantile(0.975));
    CHECK(q < 8);
    CHECK(TimeUniformQuantile(growth, 0.99) > q);
  }
}

}  // namespace lanelight::stat
