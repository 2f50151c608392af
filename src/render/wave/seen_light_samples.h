// seen-lights=apart: how the camera rays of the edges of lights are dealt out to paths.
#pragma once

#include <cstdint>

#include "src/vocabulary/path/replicates.h"

namespace lanelight {

/// Sample i of a path's pixel takes the mean of `rays` samples of another stream that has
/// `rays` times as many. Both count as observations in the same way (SampleGroups), and
/// what a path takes belongs to the replicate of the path, so that observations stay
/// independent. Within an observation the stream's points are taken in their order: n
/// paths have its first n * rays.
struct SeenLightSamples {
  SampleGroups groups;
  std::uint32_t rays = 1;

  /// Samples that take turns.
  std::uint32_t Turn() const {
    return groups.unit * (groups.replicates ? kReplicates : 1);
  }
  /// Of the stream, for the paths [begin, end) and those that take turns with them.
  std::uint64_t Begin(std::uint64_t begin) const {
    return begin / Turn() * Turn() * rays;
  }
  std::uint64_t End(std::uint64_t end) const {
    return (end + Turn() - 1) / Turn() * Turn() * rays;
  }
  /// Calls body(sample) for the rays * unit samples of the stream that path i takes the
  /// mean of; paths of one unit share theirs.
  template <class Body>
  void ForEach(std::uint64_t i, const Body& body) const {
    const std::uint64_t others = groups.replicates ? kReplicates : 1;
    const std::uint64_t unit = i / groups.unit;
    const std::uint64_t replicate = unit % others, place = unit / others;
    for (std::uint32_t k = 0; k < rays; ++k) {
      const std::uint64_t own = (place * rays + k) * others + replicate;
      for (std::uint32_t j = 0; j < groups.unit; ++j) body(own * groups.unit + j);
    }
  }
  double Count() const { return double(rays) * groups.unit; }
};

}  // namespace lanelight
