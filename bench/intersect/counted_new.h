// Counts what operator new hands out in this program.
#pragma once

#include <cstddef>

namespace lanelight::bench {

/// Bytes that are allocated now, as malloc rounds them.
std::size_t AllocatedBytes();

/// The most that AllocatedBytes() has been since the last ResetPeak().
std::size_t PeakBytes();
void ResetPeak();

}  // namespace lanelight::bench
