#include "src/measure/stress/efficiency.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/base/stat/distributions.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight::stress {
namespace {

constexpr double kConfidence = 0.95, kMaxDegreesOfFreedom = 1e9;

bool IsStrategy(const std::string& name) {
  if (name == "default") return true;
  try {
    ParseStrategy(name, {});
    return !name.empty();
  } catch (const InputError&) {
    return false;
  }
}

bool IsDefault(const std::string& name) {
  if (name == "default") return true;
  Strategy strategy;
  ApplyStrategy(name, {}, strategy);
  return strategy == Strategy{};
}

bool HasEfficiency(const JudgedPoint& judged) {
  const Point& p = judged.point;
  return judged.crash.empty() && p.refused.empty() && p.not_measured.empty() &&
         p.standard_error > 0 && std::isfinite(p.standard_error) && p.seconds > 0 &&
         p.degrees_of_freedom > 0;
}

double Cost(const Point& p) { return p.standard_error * p.standard_error * p.seconds; }

bool SameParameter(const Point& a, const Point& b) {
  return a.parameter == b.parameter ||
         (std::isnan(a.parameter) && std::isnan(b.parameter));
}

}  // namespace

bool ComparesStrategies(const CaseResult& result) {
  std::set<std::string> names;
  for (const JudgedPoint& judged : result.points) {
    if (!judged.point.series.empty()) names.insert(judged.point.series);
  }
  return names.size() >= 2 && std::all_of(names.begin(), names.end(), IsStrategy);
}

std::string BaselineOf(const CaseResult& result) {
  std::vector<std::string> names;
  for (const JudgedPoint& judged : result.points) {
    const std::string& name = judged.point.series;
    if (name == "default") return name;
    if (!name.empty()) names.push_back(name);
  }
  const auto found = std::find_if(names.begin(), names.end(), IsDefault);
  if (found != names.end()) return *found;
  return names.empty() ? "" : names.front();
}

std::optional<Interval> RelativeEfficiency(const CaseResult& result,
                                           const JudgedPoint& judged) {
  if (!HasEfficiency(judged)) return std::nullopt;
  const std::string baseline = BaselineOf(result);
  for (const JudgedPoint& other : result.points) {
    const bool same = other.point.series == baseline && other.target == judged.target &&
                      SameParameter(other.point, judged.point);
    if (!same || !HasEfficiency(other)) continue;
    const double ratio = Cost(other.point) / Cost(judged.point);
    if (judged.point.series == baseline) return WithoutBounds(1);
    // Estimated variances over true ones are F distributed.
    const double d1 = std::min(other.point.degrees_of_freedom, kMaxDegreesOfFreedom);
    const double d2 = std::min(judged.point.degrees_of_freedom, kMaxDegreesOfFreedom);
    const double tail = (1 - kConfidence) / 2;
    return Interval{ratio, ratio / stat::FQuantile(1 - tail, d1, d2),
                    ratio / stat::FQuantile(tail, d1, d2)};
  }
  return std::nullopt;
}

}  // namespace lanelight::stress
