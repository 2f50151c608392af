// Checks that what is taken to an extreme is what it must be there.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"

namespace lanelight::stress {

/// Measures at each value of a parameter and checks that all points are off by their
/// tolerance and five standard errors at most. With all points of these files a test
/// fails in fewer than 1 of 1000 seeds without a fault.
template <class Measure>
void CheckPoints(const std::vector<double>& values, const Measure& measure) {
  for (const double value : values) {
    for (const Point& p : measure(value, Effort{})) {
      CAPTURE(value, p.series, p.expected, p.measured, p.standard_error, p.tolerance);
      CHECK(std::abs(p.measured - p.expected) <= p.tolerance + 5 * p.standard_error);
      CHECK(p.invalid == 0);
    }
  }
}
/// The same of what has no parameter.
template <class Measure>
void CheckPoints(const Measure& measure) {
  CheckPoints({std::numeric_limits<double>::quiet_NaN()}, measure);
}

}  // namespace lanelight::stress
