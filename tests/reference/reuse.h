// The estimator of reuse=block, written plainly in double precision, block by block and
// pair by pair: diffuse surfaces, smooth metals, and every light of the reference tracer.
// Tests compare the means of kernels/reuse/ with it, and where no lamp can be hit, the
// variances too.
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
  bool counts_black = false;        // densities of paths that end at a black first vertex
  bool counts_other_depths = false;  // and of those with another number of mirrors before
  int silent_primitive = -2;         // paths that leave it count, and share nothing
};

/// Pixels row by row, with the variance of their means as if they were independent.
/// Blocks are made of pixels by chance, others for each sample. All materials are diffuse
/// or smooth metals, the image is one tile of the renderer at most, its filter a box.
ReferenceImage RenderReuseReference(const SceneDescription& scene,
                                    const ReuseTwinOptions& options);

}  // namespace lanelight
