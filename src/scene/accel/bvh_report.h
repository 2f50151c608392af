// The cost of finding or building the BVHs.
#pragma once

#include <cstddef>

namespace lanelight {

struct BvhReport {
  bool shared = false;    // the known tree's; else built
  double seconds = 0;     // finding or building, hashing the shapes included
  std::size_t bytes = 0;  // of the tree

  const char* Origin() const { return shared ? "shared" : "built"; }
};

}  // namespace lanelight
