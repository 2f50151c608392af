// What makes measured rates uncertain: other programs, and too few repeats.
#pragma once

#include <string>
#include <vector>

#include "src/base/core/machine_info.h"
#include "src/measure/throughput/throughput.h"

namespace lanelight {

/// Reasons why rates measured on a machine so busy say little: its load before the start
/// exceeds its cores, or rows waited for a processor. Empty if it was quiet.
std::vector<std::string> BusyReasons(const std::vector<ThroughputRow>& rows,
                                     const MachineInfo& machine);
inline constexpr double kMostWaiting = 0.1;

/// What a reader of these rows has to know, one sentence each: that the machine was busy,
/// and that medians are known less well than within `within`.
std::vector<std::string> ThroughputWarnings(const std::vector<ThroughputRow>& rows,
                                            double within);

}  // namespace lanelight
