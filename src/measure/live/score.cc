#include "src/measure/live/score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"

namespace lanelight::live {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Distances from the logarithm of an estimate to those of its ends.
struct LogError {
  double down = kInfinity, up = kInfinity;
};
LogError LogErrorOf(const Interval& error, double stretch) {
  LogError out;
  if (error.low > 0) out.down = stretch * std::log(error.value / error.low);
  if (std::isfinite(error.high)) out.up = stretch * std::log(error.high / error.value);
  return out;
}

double CostOf(const EstimateSnapshot& snapshot, Pace pace) {
  return pace == Pace::kTime ? snapshot.seconds : double(snapshot.spp);
}

// At these looks, for an interval that holds at all of them.
double StretchAt(const std::vector<EstimateSnapshot>& a,
                 const std::vector<EstimateSnapshot>& b, std::size_t i, std::size_t j) {
  const double more =
      std::max(double(a[i].spp) / double(a[0].spp), double(b[j].spp) / double(b[0].spp));
  return stat::TimeUniformQuantile(more * more, kEstimateConfidence) /
         stat::NormalQuantile(0.5 + kEstimateConfidence / 2);
}

Ahead AheadOf(const Interval& ratio) {
  return ratio.low > 1 ? Ahead::kB : ratio.high < 1 ? Ahead::kA : Ahead::kUnknown;
}

}  // namespace

Ratio EfficiencyOf(const EstimateSnapshot& a, const EstimateSnapshot& b, Pace pace,
                   double stretch) {
  Ratio ratio;
  const Interval &ea = a.error.relmse, &eb = b.error.relmse;
  if (!(ea.value > 0) || !(eb.value > 0) || !std::isfinite(ea.value) ||
      !std::isfinite(eb.value)) {
    ratio.why = "an estimated error is 0";
    return ratio;
  }
  ratio.available = true;
  const double value = ea.value * CostOf(a, pace) / (eb.value * CostOf(b, pace));
  const LogError la = LogErrorOf(ea, stretch), lb = LogErrorOf(eb, stretch);
  ratio.interval = {value, value * std::exp(-std::hypot(la.down, lb.up)),
                    value * std::exp(std::hypot(la.up, lb.down))};
  if (!std::isfinite(ea.high)) ratio.why = "of A: " + a.error.why;
  if (!std::isfinite(eb.high)) {
    ratio.why += (ratio.why.empty() ? "of B: " : "; of B: ") + b.error.why;
  }
  return ratio;
}

Ratio EfficiencyOf(const std::vector<EstimateSnapshot>& a,
                   const std::vector<EstimateSnapshot>& b, Pace pace) {
  Ratio last;
  if (a.empty() || b.empty()) {
    last.why = "errors are estimated from 8 samples per pixel on";
    return last;
  }
  Ahead ahead = Ahead::kUnknown;
  std::uint64_t since = 0;
  for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k) {
    const std::size_t i = std::min(k, a.size() - 1), j = std::min(k, b.size() - 1);
    last = EfficiencyOf(a[i], b[j], pace, StretchAt(a, b, i, j));
    const Ahead now = last.available ? AheadOf(last.interval) : Ahead::kUnknown;
    if (now == Ahead::kUnknown || now == ahead) continue;
    ahead = now;
    since = a[i].spp;
  }
  last.ahead = ahead;
  last.since = since;
  return last;
}

Ratio EfficiencyOf(const PassRenderer& a, const PassRenderer& b, Pace pace) {
  return EfficiencyOf(a.snapshots(), b.snapshots(), pace);
}

}  // namespace lanelight::live
