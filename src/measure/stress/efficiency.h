// Which strategy survives: cases whose curves are strategies, compared with the default.
#pragma once

#include <optional>
#include <string>

#include "src/base/stat/interval.h"
#include "src/measure/stress/suite.h"

namespace lanelight::stress {

/// Returns whether all curves of the case (two or more) are named as `--strategy` would
/// be told, or "default".
bool ComparesStrategies(const CaseResult& result);

/// Returns the baseline of curves that are strategies: "default", else the first that is
/// the default strategy (as "points=sobol" is), else the first.
std::string BaselineOf(const CaseResult& result);

/// Returns the efficiency 1 / (variance x processor seconds) of a point relative to the
/// baseline's at the same parameter and target. The 95 % interval is that of the ratio of
/// variances (F distribution, degrees of freedom of the standard errors); timing noise is
/// not included. Empty if either is missing, refused, or has no noise or no seconds.
std::optional<Interval> RelativeEfficiency(const CaseResult& result,
                                           const JudgedPoint& judged);

}  // namespace lanelight::stress
