// Tracing with several threads.
#pragma once

#include "bench/intersect/compare.h"

namespace lanelight::bench {

struct ThreadsResult {
  std::string mesh, set;
  double one = 0;       // Mrays/s, median
  MedianRange scaling;  // rate of 2 threads together over the rate of 1, of paired runs
};

/// Waves are dealt out in turn; the rate is the sum of the threads' rates by processor
/// time, so that it shows what they share (caches, memory), not what other programs take.
ThreadsResult BenchThreads(const Mesh& mesh, const CompiledScene& scene,
                           const RaySet& set, const CompareOptions& options);

void PrintThreads(const ThreadsResult& result);

}  // namespace lanelight::bench
