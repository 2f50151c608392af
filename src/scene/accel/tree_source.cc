#include "src/scene/accel/tree_source.h"

#include "src/base/core/stopwatch.h"

namespace lanelight {

FoundTree FindTree(const Geometry& geometry, const AccelOptions& options,
                   const KnownTree* known) {
  const Stopwatch watch;
  FoundTree tree;
  tree.report.shared = known != nullptr && known->key == KeyOf(geometry, options);
  tree.accel = tree.report.shared ? known->accel : BuildAccel(geometry, options);
  tree.report.seconds = watch.Seconds();
  tree.report.bytes = tree.accel.Bytes();
  return tree;
}

}  // namespace lanelight
