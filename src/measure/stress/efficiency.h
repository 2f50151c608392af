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

/// Of curves that are strategies. The curve that others are compared with: "default",
/// else the first that is the default strategy (as "points=sobol" is), else the first.
std::string BaselineOf(const CaseResult& result);

/// Efficiency 1 / (variance x processor seconds) of a point relative to the baseline's at
/// the same parameter and target, with a 95 % interval of the ratio of variances (F
/// distribution, degrees of freedom of the standard errors; the noise of the clock is not
/// in it). Empty where either is missing, refused, or has no noise or no seconds.
std::optional<Interval> RelativeEfficiency(const CaseResult& result,
                                           const JudgedPoint& judged);

}  // namespace lanelight::stress
