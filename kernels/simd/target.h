// Which SIMD target the kernels run on.
#pragma once

#include <string>
#include <vector>

namespace lanelight {

/// Targets compiled in that this machine can run, best first, e.g. {"AVX3", "AVX2", ...}.
std::vector<std::string> AvailableTargets();

/// Throws InputError if there is none. What kernels do then is undefined.
void RequireTarget();

/// Makes kernels resolved from now on use `name` (case-insensitive). Throws InputError
/// that lists the legal names. The empty string means the best available.
void ForceTarget(const std::string& name);

/// Name of the target that kernels resolved now would use.
std::string CurrentTarget();

/// 4-byte lanes of a full vector on that target.
int CurrentLanes();

/// Version of the Highway headers, e.g. "1.0.3".
std::string HighwayVersion();

}  // namespace lanelight
