#include "src/measure/stress/suite.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "kernels/simd/target.h"
#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"

namespace lanelight::stress {
namespace {

JudgedPoint UnmeasuredPoint(double parameter, std::string refused, std::string crash) {
  JudgedPoint point;
  point.point.parameter = parameter;
  point.point.refused = std::move(refused);
  point.crash = std::move(crash);
  return point;
}

std::vector<JudgedPoint> Try(const Case& about, double parameter, const Effort& effort) {
  try {
    std::vector<JudgedPoint> points;
    for (Point& point : about.measure(parameter, effort)) {
      point.parameter = parameter;
      points.emplace_back().point = std::move(point);
    }
    if (!points.empty()) return points;
    return {UnmeasuredPoint(parameter, "", "nothing was measured")};
  } catch (const InputError& error) {
    return {UnmeasuredPoint(parameter, error.what(), "")};
  } catch (const std::exception& error) {
    return {UnmeasuredPoint(parameter, "", error.what())};
  }
}

void Measure(double parameter, const Effort& effort, CaseResult& result) {
  const Stopwatch watch;
  std::vector<JudgedPoint> points = Try(result.about, parameter, effort);
  const double each = watch.CpuSeconds() / double(points.size());
  for (JudgedPoint& judged : points) {
    judged.target = effort.target.name();
    judged.total_seconds = each;
    if (judged.point.seconds == 0) judged.point.seconds = each;
    judged.promised =
        result.about.axis.Promised(parameter) && judged.point.not_measured.empty();
    result.points.push_back(std::move(judged));
  }
}

class SuiteRun {
 public:
  SuiteRun(const SuiteOptions& options, const SuiteHooks& hooks)
      : options_(options), hooks_(hooks) {}

  void Count(std::span<const Case> cases) {
    for (const Case& about : cases) {
      progress_.total +=
          ValuesOf(about, options_.effort.full).size() * options_.targets.size();
    }
  }

  // False if it was stopped.
  bool Measure(CaseResult& result) {
    progress_.now = &result.about;
    for (double value : ValuesOf(result.about, options_.effort.full)) {
      for (const std::string& target : options_.targets) {
        if (hooks_.stop && *hooks_.stop) return false;
        Report(target, value);
        Effort effort = options_.effort;
        effort.target = SimdTarget(target);
        stress::Measure(value, effort, result);
        ++progress_.done;
      }
    }
    result.finished = true;
    return true;
  }

 private:
  void Report(const std::string& target, double value) {
    if (!hooks_.on_progress) return;
    progress_.target = target;
    progress_.parameter = value;
    hooks_.on_progress(progress_);
  }

  const SuiteOptions& options_;
  const SuiteHooks& hooks_;
  SuiteProgress progress_;
};

// The names as the machine spells them.
std::vector<std::string> ResolveTargets(const std::vector<std::string>& wanted) {
  if (wanted.empty()) return {SimdTarget().name()};
  std::vector<std::string> names;
  for (const std::string& name : wanted) names.push_back(SimdTarget(name).name());
  return names;
}

}  // namespace

std::vector<double> ValuesOf(const Case& about, bool full) {
  const Axis& axis = about.axis;
  const std::vector<double>& values = full && !axis.full.empty() ? axis.full : axis.quick;
  if (!values.empty()) return values;
  return {std::numeric_limits<double>::quiet_NaN()};
}

SuiteResult RunSuite(std::span<const Case> cases, const SuiteOptions& options,
                     const SuiteHooks& hooks) {
  const ThreadLimit limit(options.threads);
  const Stopwatch watch;
  SuiteResult result;
  result.options = options;
  result.options.targets = ResolveTargets(options.targets);
  result.machine = ThisMachine();
  result.cases.reserve(cases.size());
  for (const Case& about : cases) result.cases.emplace_back().about = about;
  SuiteRun run(result.options, hooks);
  run.Count(cases);
  for (CaseResult& one : result.cases) {
    result.interrupted = !run.Measure(one);
    if (result.interrupted) break;
  }
  result.seconds = watch.Seconds();
  result.cpu_seconds = watch.CpuSeconds();
  JudgeSuite(result);
  return result;
}

}  // namespace lanelight::stress
