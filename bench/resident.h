// Memory of this process, as Linux counts it.
#pragma once

#include <cstddef>

namespace lanelight::bench {

/// Bytes in memory now.
std::size_t ResidentBytes();
/// The most there have been since the process began, or since ForgetPeak().
std::size_t PeakResidentBytes();
/// Begins to look for the peak anew. False where Linux does not let us.
bool ForgetPeak();

}  // namespace lanelight::bench
