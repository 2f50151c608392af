// Parts of cases: axes, renders of a text that are compared with an expected value, rates
// and bounds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/measure/stress/scene_point.h"
#include "src/measure/stress/stress_case.h"

namespace lanelight::stress {

/// Largest relative error of the mean of an image besides noise (docs/numbers.md).
inline constexpr double kFloatError = 1e-5;

/// The part of an axis that is promised.
struct PromisedRange {
  double low, high;
};

/// 10^first, 10^(first + step), ..., up to 10^last.
std::vector<double> Decades(double first, double last, double step = 1);

/// A logarithmic axis; without `full` its values are the quick ones.
Axis LogAxis(std::string name, std::string unit, PromisedRange promised_range,
             std::vector<double> quick, std::vector<double> full = {});

/// Adds cases of one group and truth.
struct CaseAdder {
  std::vector<Case>& cases;
  const char* group;
  Truth truth;

  void operator()(Case about) const {
    about.group = group;
    about.truth = truth;
    cases.push_back(std::move(about));
  }
};

/// The settings of a render.
struct Quality {
  std::uint64_t quick = 64, full = 4096;  // samples per pixel
  int depth = 5;
  int size = 8;  // pixels per side
  std::string strategy = {};
  double relative = kFloatError;  // tolerance, of what is expected
};

SceneText Setup(const std::string& text, const Quality& quality, const Effort& effort);

/// Renders and expects this mean, within kFloatError of it.
Point Expect(double expected, const SceneText& scene);
/// The same within the tolerance of the quality.
Point Expect(double expected, const std::string& text, const Quality& quality,
             const Effort& effort);
/// A plane of a material between two skies of radiance 1, seen under this cosine: what a
/// single event makes of them.
Point PlaneFurnace(double expected, const std::string& material, double cosine,
                   const Effort& effort);

/// The same, as a point of a series.
Point Named(const std::string& series, Point point);
/// A point of a series that is not measured, and why.
Point NotMeasured(const std::string& series, const std::string& why);
/// The point of a mean of two outcomes `difference` apart, the rarer with probability
/// `rare`: the scatter of the samples alone says nothing where the rare one did not come.
/// A few of them by chance are tolerated.
Point AllowForRareSamples(Point point, double rare, double difference);

}  // namespace lanelight::stress
