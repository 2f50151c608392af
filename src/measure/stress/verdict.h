// Decides whether what was measured is what must be true, and how wrong it could have
// been without being noticed.
#pragma once

#include <cstddef>
#include <string>

#include "src/measure/stress/stress_case.h"

namespace lanelight::stress {

/// Probability that any promised point of a whole run of a correct renderer fails.
inline constexpr double kFalseAlarm = 1e-4;
/// Power for which the detectable error is stated, and the most that it may be.
inline constexpr double kPower = 0.9, kWeakFrom = 0.1;

/// The level of each of `points` tests, so that a run raises a false alarm with
/// probability `family` at most, however the tests depend on each other (Bonferroni): the
/// same scene under several SIMD targets has nearly the same noise.
double LevelOf(double family, std::size_t points);

/// The reason why a point is wrong.
enum class Fault {
  kNone,
  kOff,        // further from the expected value than tolerance and noise allow
  kInvalid,    // NaN, infinite or negative samples
  kNotNumber,  // the mean or its error is no number
  kRefused,    // a message instead of a number
  kCrashed,    // an exception that is no InputError
};
/// "", "off", "invalid samples", "not a number", "refused", "crashed".
const char* Name(Fault fault);

struct PointVerdict {
  Fault fault = Fault::kNone;
  std::string why;  // a few words; empty if there is no fault
  /// Standard errors by which the error exceeds the tolerance: 0 within it, infinite
  /// where there is no noise.
  double z = 0;
  /// Largest difference between `measured` and `expected` that passes, noise included.
  double allowance = 0;
  /// Error, relative to the expected value, that would be found with a probability of
  /// kPower. Infinite: nothing would be.
  double detectable = 0;
  /// The detectable error is above kWeakFrom: passing says little.
  bool weak = false;

  bool good() const { return fault == Fault::kNone; }
};

/// Judges a point by a test of this `level`.
///
/// |measured - expected| may be the tolerance and as many standard errors as
/// Student's t has at that level, with the degrees of freedom of the standard error. So a
/// true value within the tolerance fails with probability `level` at most, as far as the
/// noise is normal. Invalid samples are a fault.
PointVerdict Judge(const Point& point, double level);

/// Returns the value that errors of a point are relative to: |expected|, or its scale.
double ScaleOf(const Point& point);

}  // namespace lanelight::stress
