// Decides whether a frustum is efficient for the next packet of nearly equal rays.
#pragma once

#include <algorithm>

#include "src/scene/geometry/accel.h"

namespace lanelight {

/// If triangles are much smaller than a packet, its frustum meets many leaves, each for
/// few rays, and a stream is up to 1.8 times as fast. The rays of a wave go through one
/// part of the image, so packets use the frustum until earlier packets have met too many
/// leaves; then only an occasional packet tries it again. Counts are in units of leaves
/// of kLeafTriangles, measured with bench/intersect/ on the camera rays of meshes; the
/// hits do not depend on it.
class FrustumTrial {
 public:
  explicit FrustumTrial(const Accel& accel)
      : unit_(kLeafTriangles / accel.leaf_triangles) {}

  /// Returns how many leaves a packet may meet before its frustum is abandoned.
  int max_leaves() const { return kMax * unit_; }

  /// Returns whether the next packet uses the frustum. Call it once per packet.
  bool IsOn() {
    if (owed_ <= kTypical * unit_) return true;
    owed_ -= unit_;
    return false;
  }

  /// Records a packet that could have met `left` leaves more.
  void Add(int left) {
    owed_ = std::max(0, owed_ + max_leaves() - left - kTypical * unit_);
  }

 private:
  // A packet that meets up to this many leaves is as fast as its rays in a stream.
  static constexpr int kTypical = 7;
  static constexpr int kMax = 24;

  int unit_;
  int owed_ = 0;  // leaves beyond kTypical
};

}  // namespace lanelight
