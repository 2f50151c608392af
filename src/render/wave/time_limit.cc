#include "src/render/wave/time_limit.h"

#include <algorithm>

namespace lanelight {

double TimeLimit::Wait() const { return std::clamp(budget_, 1.0, 10.0); }

bool TimeLimit::IsOver(bool stopped, bool every_pixel, double now) {
  if (stopped) {
    double first = -1;
    // Whoever sees it first sets it; the others get that.
    if (stop_.compare_exchange_strong(first, now)) first = now;
    return now > first + kAfterStop;
  }
  if (budget_ <= 0 || now < budget_) return false;
  if (every_pixel) return now > budget_ + kAfterStop;
  return now > std::max(budget_, last_.load()) + Wait();
}

}  // namespace lanelight
