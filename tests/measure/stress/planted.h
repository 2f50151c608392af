// Cases that measure nothing, for tests of what is made of measurements.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/measure/stress/stress_case.h"

namespace lanelight::stress {

/// A point that was expected to be 1 and is `measured`.
inline Point Around1(double measured, double standard_error = 0, double tolerance = 0) {
  Point point;
  point.expected = 1;
  point.measured = measured;
  point.standard_error = standard_error;
  point.tolerance = tolerance;
  return point;
}

/// A map over powers of ten from 1e-4 to 1e4, promised from 1e-2 to 1e2.
inline Case PlantedMap(const std::string& name,
                       std::function<std::vector<Point>(double)> measure) {
  Case planted;
  planted.name = name;
  planted.group = "planted";
  planted.extreme = "nothing, 1e-4 to 1e4";
  planted.must = "1 is 1";
  planted.axis = {"stiffness", "m", true,
                  1e-2,        1e2, {1e-4, 1e-3, 1e-2, 1e-1, 1, 1e1, 1e2, 1e3, 1e4},
                  {}};
  planted.measure = [measure](double x, const Effort&) { return measure(x); };
  return planted;
}

}  // namespace lanelight::stress
