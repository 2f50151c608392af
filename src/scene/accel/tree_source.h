// Trees that need not be built: those of the scene that was compiled before.
#pragma once

#include "src/scene/accel/build.h"
#include "src/scene/accel/tree_key.h"
#include "src/scene/accel/tree_report.h"

namespace lanelight {

struct KnownTree {
  TreeKey key;
  Accel accel;
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
