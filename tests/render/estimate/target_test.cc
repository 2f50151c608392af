// When an error estimate meets a target, and how many samples that is expected to take.
#include "src/render/estimate/estimate.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace lanelight {
namespace {

ErrorEstimate Estimated(double relmse_high, double rmse_high) {
  ErrorEstimate e;
  e.available = e.has_interval = true;
  e.relmse = {relmse_high / 2, relmse_high / 4, relmse_high};
  e.rmse = {rmse_high / 2, rmse_high / 4, rmse_high};
  return e;
}

}  // namespace

TEST_CASE("a target is reached when the upper end is below it", "[study]") {
  const ErrorEstimate e = Estimated(0.04, 0.3);
  CHECK(Reached({0.05, 0}, e));
  CHECK_FALSE(Reached({0.04, 0}, e));
  CHECK_FALSE(Reached({0.03, 0}, e));  // the value is below, the upper end is not
  CHECK(Reached({0, 0.31}, e));
  CHECK_FALSE(Reached({0, 0.29}, e));
  CHECK_FALSE(Reached({0.05, 0.29}, e));  // both, if both are set
  CHECK_FALSE(Reached({1000, 0}, ErrorEstimate{}));
}

TEST_CASE("squared errors fall like 1 / samples", "[study]") {
  const ErrorEstimate e = Estimated(0.04, 0.3);
  CHECK(SamplesNeeded({0.01, 0}, e, 100) == Approx(400));
  CHECK(SamplesNeeded({0, 0.1}, e, 100) == Approx(900));
  CHECK(SamplesNeeded({0.01, 0.1}, e, 100) == Approx(900));
  CHECK(SamplesNeeded({0.08, 0}, e, 100) == Approx(50));
  CHECK(SamplesNeeded({0.04, 0}, e, 100) > 100);  // not reached, so not enough
  CHECK(std::isinf(SamplesNeeded({0.04, 0}, ErrorEstimate{}, 100)));
}

TEST_CASE("a target without an upper bound is reported as hopeless", "[study]") {
  ErrorEstimate e = Estimated(0.04, 0.3);
  e.relmse.high = INFINITY;
  const double relmse = e.relmse.value, rmse = e.rmse.value;
  // The value is below, but not by so much that more samples could tell nothing.
  CHECK_FALSE(IsHopeless({relmse * kHopelessFactor * 0.9, 0}, e));
  CHECK(std::isinf(SamplesNeeded({relmse * kHopelessFactor * 0.9, 0}, e, 100)));
  CHECK(IsHopeless({relmse * kHopelessFactor * 1.1, 0}, e));
  CHECK(SamplesNeeded({relmse * kHopelessFactor * 1.1, 0}, e, 100) < 0);
  // What has an upper end is reached some day, and both have to be that far.
  CHECK_FALSE(IsHopeless({0, 1e6}, e));
  CHECK_FALSE(IsHopeless({relmse * kHopelessFactor * 1.1, rmse / 2}, e));
  CHECK(IsHopeless(
      {relmse * kHopelessFactor * 1.1, rmse * std::sqrt(kHopelessFactor) * 1.1}, e));
  CHECK_FALSE(IsHopeless({1e6, 0}, Estimated(0.04, 0.3)));
  CHECK_FALSE(IsHopeless({1e6, 0}, ErrorEstimate{}));
}

}  // namespace lanelight
