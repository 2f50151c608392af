#include "src/live/score.h"

#include <cmath>
#include <limits>

namespace lanelight::live {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Distances from the logarithm of an estimate to those of its ends.
struct LogError {
  double down = kInfinity, up = kInfinity;
};
LogError LogErrorOf(const Interval& error) {
  LogError out;
  if (error.low > 0) out.down = std::log(error.value / error.low);
  if (std::isfinite(error.high)) out.up = std::log(error.high / error.value);
  return out;
}

double CostOf(const Look& look, Pace pace) {
  return pace == Pace::kTime ? look.seconds : double(look.spp);
}

}  // namespace

Ratio EfficiencyOf(const Look& a, const Look& b, Pace pace) {
  Ratio ratio;
  const Interval &ea = a.error.relmse, &eb = b.error.relmse;
  if (!(ea.value > 0) || !(eb.value > 0) || !std::isfinite(ea.value) ||
      !std::isfinite(eb.value)) {
    ratio.why = "an error is estimated to be 0";
    return ratio;
  }
  ratio.available = true;
  const double value = ea.value * CostOf(a, pace) / (eb.value * CostOf(b, pace));
  const LogError la = LogErrorOf(ea), lb = LogErrorOf(eb);
  ratio.interval = {value, value * std::exp(-std::hypot(la.down, lb.up)),
                    value * std::exp(std::hypot(la.up, lb.down))};
  if (!std::isfinite(ea.high)) ratio.why = "of A: " + a.error.why;
  if (!std::isfinite(eb.high)) {
    ratio.why += (ratio.why.empty() ? "of B: " : "; of B: ") + b.error.why;
  }
  return ratio;
}

Ratio EfficiencyOf(const Contender& a, const Contender& b, Pace pace) {
  if (a.looks().empty() || b.looks().empty()) {
    Ratio ratio;
    ratio.why = "errors are estimated from 8 samples per pixel on";
    return ratio;
  }
  return EfficiencyOf(a.looks().back(), b.looks().back(), pace);
}

}  // namespace lanelight::live
