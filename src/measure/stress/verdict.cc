#include "src/measure/stress/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/stat/distributions.h"

namespace lanelight::stress {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PointVerdict Faulty(PointVerdict verdict, Fault fault, std::string why) {
  verdict.fault = fault;
  verdict.why = std::move(why);
  return verdict;
}

std::string OutOfToleranceText(const Point& point, double error) {
  const double scale = ScaleOf(point);
  if (!(scale > 0)) return fmt::format("off by {:.2g}", error);
  if (std::abs(error) > 10 * scale) {
    return fmt::format("{:.3g} instead of {:.3g}", point.measured, point.expected);
  }
  const double percent = 100 * error / scale;
  if (std::abs(percent) >= 10) return fmt::format("off by {:+.0f} %", percent);
  return fmt::format("off by {:+.2g} %", percent);
}

// The error that is found with probability kPower.
double Detectable(const Point& point, double allowance) {
  const double found = allowance + stat::NormalQuantile(kPower) * point.standard_error;
  if (found == 0) return 0;
  const double scale = ScaleOf(point);
  return scale > 0 ? found / scale : kInfinity;
}

PointVerdict JudgeValue(const Point& point, double level) {
  PointVerdict verdict;
  const double error = point.measured - point.expected;
  if (!std::isfinite(error)) {
    return Faulty(verdict, Fault::kNotNumber,
                  fmt::format("{} instead of {:.3g}", point.measured, point.expected));
  }
  const bool known =
      point.standard_error >= 0 && point.tolerance >= 0 && point.degrees_of_freedom > 0;
  if (!known || !std::isfinite(point.standard_error + point.tolerance)) {
    return Faulty(verdict, Fault::kNotNumber, "its standard error is unknown");
  }
  const double critical_value =
      stat::StudentTwoSidedQuantile(level, point.degrees_of_freedom);
  const double noise =
      point.standard_error > 0 ? critical_value * point.standard_error : 0;
  verdict.allowance = point.tolerance + noise;
  verdict.detectable = Detectable(point, verdict.allowance);
  verdict.weak = !(verdict.detectable <= kWeakFrom);
  const double excess = std::abs(error) - point.tolerance;
  if (excess > 0) verdict.z = excess / point.standard_error;  // infinite without noise
  if (excess <= noise) return verdict;
  return Faulty(verdict, Fault::kOff, OutOfToleranceText(point, error));
}

}  // namespace

double LevelOf(double family, std::size_t points) {
  LL_CHECK(family > 0 && family < 1);
  return family / double(std::max<std::size_t>(points, 1));
}

const char* Name(Fault fault) {
  constexpr const char* kNames[] = {
      "", "off", "too often", "invalid samples", "not a number", "refused", "crashed"};
  return kNames[static_cast<int>(fault)];
}

double ScaleOf(const Point& point) {
  const double expected = std::abs(point.expected);
  return expected > 0 ? expected : point.scale;
}

PointVerdict Judge(const Point& point, double level) {
  if (!point.refused.empty()) return Faulty({}, Fault::kRefused, point.refused);
  const PointVerdict verdict = JudgeValue(point, level);
  if (!verdict.good() || point.invalid == 0) return verdict;
  return Faulty(verdict, Fault::kInvalid,
                fmt::format("{} invalid samples", point.invalid));
}

}  // namespace lanelight::stress
