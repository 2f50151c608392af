// Decides whether a frustum is efficient for the next packet of nearly equal rays.
#pragma once

#include <algorithm>

#include "src/scene/geometry/accel.h"

namespace lanelight {

/// Where triangles are much smaller than a packet, its rays go ways of their own: its
/// frustum meets many leaves, each of them for few of its rays, and a stream is up to 1.8
/// times as fast. The rays of a wave go through one part of the image: packets take the
/// frustum until those before have met too many leaves, and then every so often one, to
/// see. In units of leaves of kLeafTriangles, measured with bench/intersect/ on the
/// camera rays of meshes; the hits do not depend on it.
class FrustumTrial {
 public:
  explicit FrustumTrial(const Accel& accel)
      : unit_(kLeafTriangles / accel.leaf_triangles) {}

  /// Leaves that a packet may meet; then it is given up.
  int most() const { return kMost * unit_; }

  /// To be asked once for each packet.
  bool IsOn() {
    if (owed_ <= kUsual * unit_) return true;
    owed_ -= unit_;
    return false;
  }

  /// Takes account of a packet that could have met `left` leaves more.
  void Add(int left) { owed_ = std::max(0, owed_ + most() - left - kUsual * unit_); }

 private:
  // Up to so many leaves a packet is as fast as its rays in a stream.
  static constexpr int kUsual = 7;
  static constexpr int kMost = 24;

  int unit_;
  int owed_ = 0;  // leaves beyond the usual
};

}  // namespace lanelight
