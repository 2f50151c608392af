// The verdict on a point: planted faults are found, correct points pass, and what is
// said of the power is true.
#include "src/measure/stress/verdict.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/measure/stress/planted.h"

namespace lanelight::stress {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLevel = 1e-6;  // 4.892 standard errors

Fault FaultOf(const Point& point) { return Judge(point, kLevel).fault; }

}  // namespace

TEST_CASE("stress: without noise the tolerance decides", "[stress]") {
  CHECK(FaultOf(Around1(1)) == Fault::kNone);
  CHECK(FaultOf(Around1(1 + 1e-15)) == Fault::kOff);
  CHECK(FaultOf(Around1(1.0009, 0, 1e-3)) == Fault::kNone);
  CHECK(FaultOf(Around1(0.9989, 0, 1e-3)) == Fault::kOff);
  CHECK(std::isinf(Judge(Around1(1.1), kLevel).z));
  CHECK(Judge(Around1(1.1), kLevel).why == "off by +10 %");
}

TEST_CASE("stress: the significance level allows for noise", "[stress]") {
  CHECK(FaultOf(Around1(1 + 4.89 * 0.01, 0.01)) == Fault::kNone);
  CHECK(FaultOf(Around1(1 - 4.90 * 0.01, 0.01)) == Fault::kOff);
  CHECK(FaultOf(Around1(1 + 5 * 0.01, 0.01)) == Fault::kOff);
  // Both together, and z counts beyond the tolerance.
  CHECK(FaultOf(Around1(1.02 + 4.89 * 0.01, 0.01, 0.02)) == Fault::kNone);
  const PointVerdict off = Judge(Around1(1.02 + 0.05, 0.01, 0.02), kLevel);
  CHECK(off.fault == Fault::kOff);
  CHECK(off.z == Approx(5));
  // Four estimates of the noise say less than infinitely many: Student's t.
  Point few = Around1(1 + 0.3, 0.01);
  few.degrees_of_freedom = 3;
  CHECK(FaultOf(few) == Fault::kNone);
  few.measured = 1 + 1.5;  // t of 1e-6 with 3 degrees of freedom: 103.3
  CHECK(FaultOf(few) == Fault::kOff);
}

TEST_CASE("stress: NaN fails", "[stress]") {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    CHECK(FaultOf(Around1(bad)) == Fault::kNotNumber);
    CHECK(FaultOf(Around1(1, bad)) == Fault::kNotNumber);
    CHECK(FaultOf(Around1(1, 0.1, bad)) == Fault::kNotNumber);
  }
  CHECK(FaultOf(Around1(1, -0.1)) == Fault::kNotNumber);
  CHECK(FaultOf(Around1(1, 0, -0.1)) == Fault::kNotNumber);
  Point invalid = Around1(1);
  invalid.invalid = 1;
  CHECK(FaultOf(invalid) == Fault::kInvalid);
  Point refused = Around1(1);
  refused.refused = "scene:1: error: too large";
  CHECK(FaultOf(refused) == Fault::kRefused);
  CHECK(Judge(refused, kLevel).why == refused.refused);
}

TEST_CASE("stress: a check that cannot fail is weak", "[stress]") {
  const auto weak = [](const Point& p) { return Judge(p, kLevel).weak; };
  CHECK_FALSE(weak(Around1(1)));
  CHECK_FALSE(weak(Around1(1, 0, 0.09)));
  CHECK(weak(Around1(1, 0, 0.11)));
  CHECK_FALSE(weak(Around1(1, 0.1 / 6.2)));  // 4.892 + 1.282 standard errors
  CHECK(weak(Around1(1, 0.1 / 6.1)));
  Point zero = Around1(0, 1e-6);
  zero.expected = 0;
  CHECK(weak(zero));  // relative to what?
  zero.scale = 1;
  CHECK_FALSE(weak(zero));
}

TEST_CASE("stress: the detectable error is found nine times in ten", "[stress]") {
  // A draw outside 5 standard deviations of the binomial: one in 1.7 million.
  constexpr int kDraws = 20000;
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 0.01);
  const PointVerdict verdict = Judge(Around1(1, 0.01, 0.004), kLevel);
  int found = 0;
  for (int i = 0; i < kDraws; ++i) {
    found += FaultOf(Around1(1 + verdict.detectable + noise(random), 0.01, 0.004)) ==
             Fault::kOff;
  }
  CHECK(std::abs(found - kPower * kDraws) < 5 * std::sqrt(kDraws * 0.9 * 0.1));
}

}  // namespace lanelight::stress
