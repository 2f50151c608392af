#include "src/measure/stress/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/stat/distributions.h"

namespace lanelight::stress {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// P(X >= count) of a binomial.
double AtLeast(double count, double trials, double rate) {
  if (count <= 0) return 1;
  if (count > trials || rate <= 0) return 0;
  return rate >= 1 ? 1 : stat::BetaI(count, trials - count + 1, rate);
}

// The least count that the test rejects; trials + 1 if it rejects none.
double FirstRejected(double trials, double rate, double level) {
  double accepted = 0, rejected = trials + 1;
  while (rejected - accepted > 1) {
    const double middle = std::floor((accepted + rejected) / 2);
    (AtLeast(middle, trials, rate) <= level ? rejected : accepted) = middle;
  }
  return rejected;
}

// The rate that gives `count` or more with probability kPower.
double RateFound(double count, double trials) {
  if (count > trials) return kInfinity;
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (AtLeast(count, trials, middle) < kPower ? low : high) = middle;
  }
  return high;
}

PointVerdict Faulty(PointVerdict verdict, Fault fault, std::string why) {
  verdict.fault = fault;
  verdict.why = std::move(why);
  return verdict;
}

PointVerdict JudgeRate(const Point& point, double level) {
  PointVerdict verdict;
  if (point.trials == 0 || point.failures > point.trials || !(point.expected >= 0)) {
    return Faulty(verdict, Fault::kNotNumber, "a rate without trials");
  }
  const double trials = double(point.trials), failures = double(point.failures);
  const double p = AtLeast(failures, trials, point.expected);
  const double rejected = FirstRejected(trials, point.expected, level);
  verdict.z = p <= 0 ? kInfinity : p >= 0.5 ? 0 : -stat::NormalQuantile(p);
  verdict.allowance = std::max(0.0, (rejected - 1) / trials - point.expected);
  verdict.detectable = RateFound(rejected, trials);
  verdict.weak = verdict.detectable > kWeakFrom;
  if (p > level) return verdict;
  return Faulty(verdict, Fault::kTooOften,
                fmt::format("{} of {} failed, {:.3g} promised", point.failures,
                            point.trials, point.expected));
}

std::string OffText(const Point& point, double error) {
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
    return Faulty(verdict, Fault::kNotNumber, "its error is not known");
  }
  const double most = stat::StudentTwoSidedQuantile(level, point.degrees_of_freedom);
  const double noise = point.standard_error > 0 ? most * point.standard_error : 0;
  verdict.allowance = point.tolerance + noise;
  verdict.detectable = Detectable(point, verdict.allowance);
  verdict.weak = !(verdict.detectable <= kWeakFrom);
  const double excess = std::abs(error) - point.tolerance;
  if (excess > 0) verdict.z = excess / point.standard_error;  // infinite without noise
  if (excess <= noise) return verdict;
  return Faulty(verdict, Fault::kOff, OffText(point, error));
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

PointVerdict Judge(Truth truth, const Point& point, double level) {
  if (!point.refused.empty()) return Faulty({}, Fault::kRefused, point.refused);
  if (truth == Truth::kRate) return JudgeRate(point, level);
  const PointVerdict verdict = JudgeValue(point, level);
  if (!verdict.good() || point.invalid == 0) return verdict;
  return Faulty(verdict, Fault::kInvalid,
                fmt::format("{} invalid samples", point.invalid));
}

}  // namespace lanelight::stress
