// The estimator of reuse=block as one would write it down: for diffuse surfaces and
// lights that no direction can hit, in double precision, block by block and pair by pair.
// What kernels/reuse/ does in lanes is compared with it, means and variances alike.
#pragma once

#include "tests/reference/path_tracer.h"

namespace lanelight {

struct ReuseTwinOptions {
  int block = 16;     // paths that are connected; divides the number of pixels
  int samples = 64;   // per pixel
  double kept = 0.5;  // of second vertices that send light
  std::uint64_t seed = 1;
  /// Faults, for tests that are to find them.
  bool forgets_visibility = false;  // in the denominator
  bool counts_owner_twice = false;  // in the denominator
  bool forgets_roulette = false;    // what is kept is not made brighter
};

/// Pixels row by row, with the variance of their means as if they were independent.
/// Blocks are made of pixels by chance, others for each sample. All materials are
/// diffuse, the image is one tile of the renderer at most, and its filter is a box.
ReferenceImage RenderReuseReference(const SceneDescription& scene,
                                    const ReuseTwinOptions& options);

}  // namespace lanelight
