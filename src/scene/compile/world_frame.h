// The frame that compiled coordinates are written in: recentred, and scaled by a power of
// two, so that float32 resolves the scene equally well whatever its units and wherever it
// lies. Everything up to the last rounding happens in double precision.
#pragma once

#include <cmath>

#include "src/base/core/motion.h"
#include "src/base/core/transform.h"
#include "src/base/core/vec.h"

namespace lanelight {

inline Vec3f ToFloat(Vec3d v) { return VecCast<float>(v); }
inline bool IsFinite(Vec3d v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Axis-aligned box in double precision; empty until a finite point is added.
struct Box {
  Vec3d min{INFINITY, INFINITY, INFINITY}, max{-INFINITY, -INFINITY, -INFINITY};

  bool empty() const { return !(min.x <= max.x); }
  /// Points that are not finite are ignored.
  void Add(Vec3d p);
  void Add(const Box& other);
  /// The box of this box's corners after the transform.
  Box Transformed(const Transform& transform) const;
  Vec3d Center() const { return min * 0.5 + max * 0.5; }
  double HalfDiagonal() const;
};

/// p_frame = (p - center) * scale.
struct WorldFrame {
  Vec3d center;
  double scale = 1;  // power of two

  Vec3d Point(Vec3d p) const { return (p - center) * scale; }
  /// frame_from_local, given the transform of local to unframed coordinates. Subtracts
  /// the centre from the translation first: a tiny mesh placed by a large translation
  /// keeps all the digits it has in its own coordinates.
  Transform After(const Transform& transform) const;
  /// The transform from frame to unframed coordinates.
  Transform Inverse() const;
};

/// Centre of the box, and the power of two that brings its half diagonal into [1, 2).
/// An empty box gives the identity, a single point a scale of 1.
WorldFrame FrameOf(const Box& box);

inline void Store(Vec3d v, float out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

inline void Store(const Transform& t, float out[12]) {
  for (int i = 0; i < 12; ++i) out[i] = static_cast<float>(t(i / 4, i % 4));
}

/// Returns the motion from an object's frame to the scene's, given the one from object to
/// world coordinates.
Motion InFrames(const Motion& motion, const WorldFrame& scene, const WorldFrame& object);

/// Returns the motion of the scene relative to a camera, in the scene's frame, given the
/// camera's motion in the world.
Motion OfCamera(const Motion& motion, const WorldFrame& scene);

}  // namespace lanelight
