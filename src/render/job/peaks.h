// What this machine can do at most, measured: read bandwidth of each level of memory and
// the multiply-add peak of a SIMD target. One thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernels/simd/target.h"

namespace lanelight {

/// A level of memory: the caches that the system knows of, and main memory.
struct MemoryLevel {
  std::string name;             // "L1", "L2", "L3", "memory"
  std::size_t bytes = 0;        // its size; of main memory: of the machine
  std::size_t probe = 0;        // bytes that were read to measure it
  double bytes_per_second = 0;  // of contiguous reads; best of several trials
};

struct Peaks {
  std::vector<MemoryLevel> levels;  // from the nearest to the farthest
  double flops = 0;                 // single precision operations per second
  double fma_ipc = 0;               // instructions per cycle at that; 0 if unknown
  double seconds = 0;               // that the measurement took

  /// The nearest level that is larger than `bytes`.
  const MemoryLevel& LevelOf(double bytes) const;
};

/// Measures for about half a second. The answer of every loop is checked (CheckFailure),
/// so that none can be optimised away. `counters`: read the processor's, if they are
/// there.
Peaks MeasurePeaks(SimdTarget target, bool counters);

}  // namespace lanelight
