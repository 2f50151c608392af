// Which of two renderers gets further, by what both estimate of their own errors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"
#include "src/measure/live/pass_renderer.h"

namespace lanelight::live {

/// The quantity that two renderers have in common.
enum class Pace { kTime, kSamples };

/// Who is ahead, as far as the intervals show it.
enum class Ahead { kUnknown, kA, kB };

struct Ratio {
  bool available = false;  // both have estimated their error
  Interval interval;       // infinite or 0 where an end is not known
  std::string why;         // an end is not known; or it is not available
  /// The last look whose interval excluded 1 decides; it stays until a look shows the
  /// opposite.
  Ahead ahead = Ahead::kUnknown;
  std::uint64_t since = 0;  // samples per pixel of A at the first look that showed it
};

/// The efficiency of `b` relative to `a`: of 1 / (relMSE x processor time), or of 1 /
/// (relMSE x samples); above 1, `b` is better. Errors fall as 1 / cost, so that the two
/// need not have cost the same. The interval joins those of two independent errors: their
/// logarithms are a difference, of whose ends the distances add as squares (variance
/// estimates recovery, Zou and Donner 2008). It does not include the scatter of the
/// clock. `stretch` multiplies the distances; with 1 the interval holds at one look that
/// was chosen beforehand, with kEstimateConfidence.
Ratio EfficiencyOf(const EstimateSnapshot& a, const EstimateSnapshot& b, Pace pace,
                   double stretch = 1);

/// The efficiency by all looks: the interval is that of the last look, and intervals hold
/// at all looks together with kEstimateConfidence (src/base/stat/hypothesis.h),
/// so a viewer may stop at any of them. The squared sums of the pixels' errors, less what
/// is expected of them, are a martingale whose variance grows with the square of the
/// samples.
Ratio EfficiencyOf(const std::vector<EstimateSnapshot>& a,
                   const std::vector<EstimateSnapshot>& b, Pace pace);
Ratio EfficiencyOf(const PassRenderer& a, const PassRenderer& b, Pace pace);

}  // namespace lanelight::live
