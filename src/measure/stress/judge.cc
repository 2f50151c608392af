// Judges the points of a run.
#include <algorithm>
#include <cmath>
#include <set>

#include "src/measure/stress/suite.h"

namespace lanelight::stress {
namespace {

PointVerdict VerdictOf(const JudgedPoint& judged, double level) {
  if (!judged.point.not_measured.empty()) return {};
  if (judged.crash.empty()) return Judge(judged.point, level);
  PointVerdict verdict;
  verdict.fault = Fault::kCrashed;
  verdict.why = judged.crash;
  return verdict;
}

// Returns the deviation of a point relative to the allowed one; above 1 it fails.
double Used(const JudgedPoint& judged) {
  if (!judged.verdict.good()) return std::numeric_limits<double>::infinity();
  const double off = std::abs(judged.point.measured - judged.point.expected);
  return judged.verdict.allowance > 0 ? off / judged.verdict.allowance : 0;
}

void CountPromised(CaseResult& result) {
  double maximum = -1;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const JudgedPoint& judged = result.points[i];
    result.not_measured += !judged.point.not_measured.empty();
    if (!judged.promised) continue;
    ++result.promised;
    result.failed += !judged.verdict.good();
    result.weak += judged.verdict.weak;
    result.detectable = std::max(result.detectable, judged.verdict.detectable);
    const double used = Used(judged);
    if (used <= maximum) continue;
    maximum = used;
    result.worst = static_cast<int>(i);
  }
}

std::string FailureText(const CaseResult& result) {
  if (result.promised == 0) return "no point in the supported range was measured";
  const JudgedPoint& worst = result.points[static_cast<std::size_t>(result.worst)];
  return worst.verdict.why;
}

// The first bad point of one curve on one side. A refusal of all curves at a value has no
// name of a series.
BreakPlace FirstBreak(const CaseResult& result, const std::string& target,
                      const std::string& series, bool above) {
  const Axis& axis = result.about.axis;
  const JudgedPoint* first = nullptr;
  for (const JudgedPoint& judged : result.points) {
    const double x = judged.point.parameter;
    const bool outside = above ? x > axis.promised_high : x < axis.promised_low;
    const bool mine = judged.point.series == series || judged.point.series.empty();
    if (!outside || !mine || judged.target != target || judged.verdict.good()) continue;
    const bool nearer =
        !first || (above ? x < first->point.parameter : x > first->point.parameter);
    if (nearer) first = &judged;
  }
  if (!first) return {};
  return {target,
          series,
          above,
          first->point.parameter,
          first->verdict.fault,
          first->verdict.why};
}

std::set<std::string> SeriesOf(const CaseResult& result) {
  std::set<std::string> names;
  for (const JudgedPoint& judged : result.points) names.insert(judged.point.series);
  if (names.size() > 1) names.erase("");
  return names;
}

void FindBreaks(const std::vector<std::string>& targets, CaseResult& result) {
  for (const std::string& target : targets) {
    for (const std::string& series : SeriesOf(result)) {
      for (const bool above : {false, true}) {
        const BreakPlace place = FirstBreak(result, target, series, above);
        if (place.fault != Fault::kNone) result.breaks.push_back(place);
      }
    }
  }
}

Outcome OutcomeOf(const CaseResult& result) {
  if (result.failed > 0) return Outcome::kFailed;
  if (!result.finished) return Outcome::kUnfinished;
  if (result.promised == 0) return Outcome::kFailed;
  return result.weak > 0 ? Outcome::kWeak : Outcome::kGood;
}

void JudgeCase(const SuiteResult& suite, CaseResult& result) {
  for (JudgedPoint& judged : result.points) {
    judged.verdict = VerdictOf(judged, suite.level);
  }
  result.worst = -1;
  result.promised = result.failed = result.weak = result.not_measured = 0;
  result.detectable = 0;
  result.breaks.clear();
  CountPromised(result);
  FindBreaks(suite.options.targets, result);
  result.outcome = OutcomeOf(result);
  result.why = result.outcome == Outcome::kFailed ? FailureText(result) : "";
}

}  // namespace

const char* Name(Outcome outcome) {
  constexpr const char* kNames[] = {"good", "weak", "failed", "unfinished"};
  return kNames[static_cast<int>(outcome)];
}

int SuiteResult::Count(Outcome outcome) const {
  return static_cast<int>(
      std::count_if(cases.begin(), cases.end(),
                    [&](const CaseResult& one) { return one.outcome == outcome; }));
}

void JudgeSuite(SuiteResult& result) {
  result.promised = 0;
  for (const CaseResult& one : result.cases) {
    for (const JudgedPoint& judged : one.points) result.promised += judged.promised;
  }
  result.level = LevelOf(result.options.false_alarm, result.promised);
  for (CaseResult& one : result.cases) JudgeCase(result, one);
}

}  // namespace lanelight::stress
