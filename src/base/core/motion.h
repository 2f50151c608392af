// A transform that changes with time, as pbrt-v4 has it (Pharr, Jakob and Humphreys 2023,
// section 3.12; Shoemake and Duff 1992): both ends are taken apart into translation,
// rotation and a symmetric rest, each of which goes evenly from one end to the other, the
// rotation the shorter way round.
#pragma once

#include "src/base/core/transform.h"
#include "src/base/core/vec.h"

namespace lanelight {

/// Parts that a motion on curved ways is bounded in.
inline constexpr int kMotionParts = 64;

/// At s from 0 to 1 the point p is at
///   from + s way + R(s) (linear + s change) (pivot + p),
/// where R(s) turns by s * angle about `axis`.
struct Motion {
  using Matrix3 = std::array<Vec3d, 3>;  // rows

  Matrix3 linear = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, change = {};
  Vec3d from, way, pivot;
  Vec3d axis{0, 0, 1};  // unit
  double angle = 0;     // 0 to pi

  /// No motion, at the origin.
  Motion() = default;
  /// Both transforms must be affine and invertible, and HaveMotion.
  Motion(const Transform& start, const Transform& end);

  Transform At(double s) const;
  /// Parts of s after which to ask where things are: within each, a point with
  /// |coordinates| up to `reach` keeps as near as `Deviation` to the straight way between
  /// where it is at the part's ends.
  int Parts() const { return angle == 0 ? 1 : kMotionParts; }
  double Deviation(double reach) const;
};

/// Returns whether there is a motion from one to the other: not if one mirrors and the
/// other does not, since what is in between would be flat.
inline bool HaveMotion(const Transform& start, const Transform& end) {
  return start.SwapsHandedness() == end.SwapsHandedness();
}

}  // namespace lanelight
