// A budget determines the number of samples.
#include "src/measure/study/scene_runner.h"

#include <catch2/catch.hpp>

namespace lanelight {

TEST_CASE("study: training counts once, not per sample", "[study]") {
  // 0.3 s before the first sample, and 0.01 s each: a budget of 2 s is enough for 170.
  CHECK(SamplesOfBudget(2, {64, 0.94}, {16, 0.46}) == Approx(170));
  CHECK(SamplesOfBudget(2, {64, 0.64}, {16, 0.16}) == Approx(200));
  // Noise: the smaller one took as long, or less than its share.
  CHECK(SamplesOfBudget(2, {64, 0.64}, {16, 0.64}) == Approx((2 - 0.48) / 0.0025));
  CHECK(SamplesOfBudget(2, {64, 0.64}, {16, 0.1}) == Approx(200));
  // One sample is all that there is time for.
  CHECK(SamplesOfBudget(2, {1, 4}, {1, 4}) == Approx(0.5));
}

TEST_CASE("study: sample counts double up to the largest", "[study]") {
  CHECK(CountsUpTo(5) == std::vector<std::uint64_t>{1, 2, 4, 5});
  CHECK(CountsUpTo(1000) ==
        std::vector<std::uint64_t>{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000});
  CHECK(CountsUpTo(1003).back() == 1000);
}

}  // namespace lanelight
