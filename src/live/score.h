// Which of two contenders gets further, by what both estimate of their own errors.
#pragma once

#include <string>

#include "src/live/contender.h"
#include "src/stat/interval.h"

namespace lanelight::live {

/// What two contenders have in common: the other may cost more, or need more.
enum class Pace { kTime, kSamples };

struct Ratio {
  bool available = false;  // both have estimated their error
  Interval interval;       // infinite or 0 where an end is not known
  std::string why;         // an end is not known; or it is not available
};

/// The efficiency of `b` relative to `a`: of 1 / (relMSE x processor time), or of
/// 1 / (relMSE x samples); above 1, `b` is better. Errors fall as 1 / cost, so that the
/// two need not have cost the same. Of the interval, with kEstimateConfidence: the
/// logarithms of two independent errors are a difference, of whose ends the distances
/// add as squares (variance estimates recovery, Zou and Donner 2008). How much the clock
/// itself scatters is not in it.
Ratio EfficiencyOf(const Contender& a, const Contender& b, Pace pace);
Ratio EfficiencyOf(const Look& a, const Look& b, Pace pace);

}  // namespace lanelight::live
