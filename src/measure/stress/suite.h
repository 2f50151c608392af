// Runs cases over their axes and SIMD targets, and judges what they measure.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "src/base/core/machine_info.h"
#include "src/measure/stress/stress_case.h"
#include "src/measure/stress/verdict.h"

namespace lanelight::stress {

struct SuiteOptions {
  std::vector<std::string> targets;  // names of SIMD targets; empty: the best
  int threads = 0;                   // 0: all cores
  Effort effort;                     // but for its target
  double false_alarm = kFalseAlarm;  // of the whole run
};

/// A point, where it was measured and what is to be said of it.
struct JudgedPoint {
  std::string target;
  Point point;
  std::string crash;      // message of an exception that is no InputError
  bool promised = false;  // and measured
  PointVerdict verdict;
  double total_seconds = 0;  // of processor time, building the scene included
};

/// The first point that is not good on the way out of the promised range.
struct BreakPlace {
  std::string target, series;
  bool above = false;  // of the promised range, else below
  double parameter = 0;
  Fault fault = Fault::kNone;
  std::string why;
};

enum class Outcome {
  kGood,
  kWeak,        // good, but a promised point could not have seen an error of 10 %
  kFailed,      // a promised point is not good, or none was measured
  kUnfinished,  // the run was stopped before its end
};
/// "good", "weak", "failed", "unfinished".
const char* Name(Outcome outcome);

struct CaseResult {
  Case about;
  std::vector<JudgedPoint> points;  // by parameter, then target, then series
  bool finished = false;
  // JudgeSuite computes the following members.
  Outcome outcome = Outcome::kUnfinished;
  std::string why;  // of a failure
  /// Index of the promised point that says most: the first that is not good, else the
  /// one that uses the largest part of what it may be off; -1 if there is none.
  int worst = -1;
  int promised = 0, failed = 0, weak = 0;  // promised points
  int not_measured = 0;
  double detectable = 0;           // the largest of the promised points
  std::vector<BreakPlace> breaks;  // outside of the promise
};

struct SuiteResult {
  SuiteOptions options;  // `targets` has their names
  std::vector<CaseResult> cases;
  MachineInfo machine;  // that measured them
  bool interrupted = false;
  double seconds = 0, cpu_seconds = 0;
  std::size_t promised = 0;  // points
  double level = 0;          // of the test of each

  int Count(Outcome outcome) const;
};

struct SuiteProgress {
  const Case* now = nullptr;
  std::string target;
  double parameter = 0;
  std::size_t done = 0, total = 0;  // measurements
};

struct SuiteHooks {
  std::function<void(const SuiteProgress&)> on_progress;  // before each measurement
  const std::atomic<bool>* stop = nullptr;  // finish the measurement in hand, no more
};

/// The values of the axis that a case is measured at; NaN for a case of a single point.
std::vector<double> ValuesOf(const Case& about, bool full);

/// Measures all, one point after the other, so that times mean something; each render
/// uses all threads. Whatever a case throws is a result: a refusal if it is an
/// InputError, else a crash. Throws InputError for a target that this machine has not.
SuiteResult RunSuite(std::span<const Case> cases, const SuiteOptions& options,
                     const SuiteHooks& hooks = {});

/// Fills in everything that follows from the points.
void JudgeSuite(SuiteResult& result);

}  // namespace lanelight::stress
