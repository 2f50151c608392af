// Trees that need not be built: those of the scene that was compiled before.
#pragma once

#include <cstddef>

#include "src/scene/accel/accel.h"
#include "src/scene/accel/tree_key.h"

namespace lanelight {

struct KnownTree {
  TreeKey key;
  Accel accel;
};

struct TreeReport {
  bool shared = false;    // the known tree's; else built
  double seconds = 0;     // finding or building, hashing the shapes included
  std::size_t bytes = 0;  // of the tree

  const char* Origin() const { return shared ? "shared" : "built"; }
};

struct FoundTree {
  Accel accel;
  TreeReport report;
};

/// Returns the tree of `known`, which may be null, if it is of the same shapes; else
/// BuildAccel's.
FoundTree FindTree(const Geometry& geometry, const AccelOptions& options,
                   const KnownTree* known);

}  // namespace lanelight
