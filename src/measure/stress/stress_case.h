// Cases of the stress suite. A case takes a parameter to an extreme and states what must
// be true there.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/simd/target.h"

namespace lanelight::stress {

/// The source of the expected value.
enum class Truth {
  kClosedForm,  // a formula, evaluated in double precision
  kInvariance,  // the same scene told otherwise (other units, place, order)
  kTwin,        // an independent computation: scalar, double precision, by hand
};
inline const char* Name(Truth truth) {
  constexpr const char* kNames[] = {"closed form", "invariance", "twin"};
  return kNames[static_cast<int>(truth)];
}

/// One measurement, at one value of the parameter. Members without a meaning keep their
/// defaults.
struct Point {
  double parameter = std::numeric_limits<double>::quiet_NaN();
  std::string series;  // a curve of the map (a strategy, a shape); empty: there is one
  double expected = 0, measured = 0;
  double standard_error = 0;  // of `measured` (and of `expected`, if it has one)
  /// Largest absolute error of `measured` besides noise: the bound that the documentation
  /// promises. Never made wider to pass.
  double tolerance = 0;
  std::uint64_t invalid = 0;  // NaN, infinite or negative samples
  std::uint64_t samples = 0, rays = 0;
  std::uint64_t lanes_used = 0, lane_slots = 0;  // of all stages
  double seconds = 0;                            // of processor time
  /// The renderer's message, if it refused: what it may do outside of the promised range
  /// only. (An InputError that `measure` throws is a refusal of all series.)
  std::string refused;
  /// Why this point says nothing, by the case's own reckoning: light too rare to be
  /// sampled, a choice that does not fit the scene. Such a point is in neither the map
  /// nor the verdict, but in the report.
  std::string not_measured;
  /// Degrees of freedom of `standard_error`, which is an estimate; infinite: it is known.
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
  /// Errors are relative to this if it is not 0 (e.g. the size of the terms of a
  /// difference that is 0), else to `expected`.
  double scale = 0;

  bool operator==(const Point&) const = default;
};

/// The work that a point may take.
struct Effort {
  bool full = false;  // as many samples and rays as give a sharp answer; else a glance
  std::uint64_t seed = 1;
  SimdTarget target;
  /// Picks by effort: quick or full.
  template <class T>
  T operator()(T quick, T whole) const {
    return full ? whole : quick;
  }
};

/// The parameter that a map goes through. Points inside [low, high] are promised to be
/// right; those outside show what happens there. A case of a single point has no name.
struct Axis {
  std::string name, unit;  // "GGX alpha", ""
  bool logarithmic = true;
  double promised_low = -std::numeric_limits<double>::infinity();
  double promised_high = std::numeric_limits<double>::infinity();
  std::vector<double> quick, full;  // values, ascending

  bool Promised(double parameter) const {
    return !(parameter < promised_low) && !(parameter > promised_high);
  }
};

/// One case: a line of a table in src/measure/stress/cases/.
struct Case {
  std::string name;     // unique, lower case with hyphens: "ggx-alpha"
  std::string extreme;  // what is extreme, and its range, as a sentence
  std::string must;     // what must be true
  Axis axis;
  /// Measures at one value of the axis (NaN for a single point); one Point per series.
  /// Deterministic for a seed. Throws InputError only if the scene is to be refused.
  std::function<std::vector<Point>(double parameter, const Effort& effort)> measure;
  std::string source = {};  // where it is known to break renderers; empty: our own
  std::string group = {};   // "materials", "lights", "strategies", ...
  Truth truth = Truth::kClosedForm;
};

}  // namespace lanelight::stress
