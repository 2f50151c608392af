// When camera packets take the frustum.
#include "kernels/intersect/frustum_trial.h"

#include <catch2/catch.hpp>

namespace lanelight {
namespace {

// Of `packets` that meet so many leaves each, how many take the frustum.
int FrustumPackets(FrustumTrial& trial, int packets, int leaves) {
  int packets_seen = 0;
  for (int i = 0; i < packets; ++i) {
    if (!trial.IsOn()) continue;
    ++packets_seen;
    trial.Add(trial.max_leaves() - leaves);
  }
  return packets_seen;
}

Accel LeavesOf(int triangles) {
  Accel accel;
  accel.leaf_triangles = triangles;
  return accel;
}

TEST_CASE("packets use the frustum while they visit few leaves") {
  for (const int triangles : {kLeafTriangles, kLeafTriangles / 2}) {
    const int unit = kLeafTriangles / triangles;
    const Accel accel = LeavesOf(triangles);
    FrustumTrial trial(accel);
    CHECK(FrustumPackets(trial, 1000, 4 * unit) == 1000);
    // Earlier savings do not offset many leaves later.
    const int dense = FrustumPackets(trial, 1000, 20 * unit);
    CHECK(dense >= 1000 / 20);
    CHECK(dense <= 1000 / 10);
    // One in so many is tried, so that it soon goes on where triangles are larger.
    CHECK(FrustumPackets(trial, 1000, 4 * unit) >= 980);
  }
}

TEST_CASE("a single packet that visits many leaves does not disable the frustum") {
  const Accel accel = LeavesOf(kLeafTriangles);
  FrustumTrial trial(accel);
  int packets_seen = 0;
  for (int i = 0; i < 100; ++i) {
    packets_seen += FrustumPackets(trial, 1, 14);
    packets_seen += FrustumPackets(trial, 4, 4);
  }
  CHECK(packets_seen == 500);
}

TEST_CASE("an aborted packet counts all leaves that it visited") {
  const Accel accel = LeavesOf(kLeafTriangles);
  FrustumTrial trial(accel);
  REQUIRE(trial.IsOn());
  trial.Add(-1);
  CHECK_FALSE(trial.IsOn());
}

}  // namespace
}  // namespace lanelight
