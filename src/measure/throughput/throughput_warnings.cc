#include "src/measure/throughput/throughput_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lanelight {

std::vector<std::string> BusyReasons(const std::vector<ThroughputRow>& rows,
                                     const MachineInfo& machine) {
  std::vector<std::string> reasons;
  if (IsOverloaded(machine)) {
    reasons.push_back(
        fmt::format("the load before the start, {:.2f}, exceeds the {:.3g} "
                    "cores of the machine",
                    *machine.load, *CoresAtATime(machine)));
  }
  double worst = 0;
  for (const ThroughputRow& row : rows) worst = std::max(worst, row.Waiting());
  if (worst > kMostWaiting) {
    reasons.push_back(fmt::format(
        "threads waited for a processor up to {:.0f} % of the time", 100 * worst));
  }
  return reasons;
}

std::vector<std::string> ThroughputWarnings(const std::vector<ThroughputRow>& rows,
                                            double within) {
  std::vector<std::string> warnings;
  if (const auto busy = BusyReasons(rows, ThisMachine()); !busy.empty()) {
    warnings.push_back(fmt::format(
        "The machine was busy: {}. Rates per second of processor time say more.",
        fmt::join(busy, "; ")));
  }
  double worst = 0;
  for (const ThroughputRow& row : rows) worst = std::max(worst, row.Spread());
  if (worst > within) {
    warnings.push_back(fmt::format(
        "Not all medians are known within {:.3g} %: the worst {}. The machine is not "
        "quiet, or --time is too short.",
        100 * within,
        std::isfinite(worst) ? fmt::format("within {:.2g} %", 100 * worst)
                             : "has no interval"));
  }
  return warnings;
}

}  // namespace lanelight
