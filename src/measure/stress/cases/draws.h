// Numbers to draw shapes and rays from.
#pragma once

#include <cstdint>
#include <random>

#include "src/base/core/vec.h"

namespace lanelight::stress {

/// A unit normal along no axis.
inline const Vec3d kLeaning = Normalize(Vec3d{0.3, -0.5, 0.8});

/// Two unit vectors across the unit vector n and each other.
struct Across {
  Vec3d u, v;
  explicit Across(Vec3d n);

  /// The unit vector at an angle to u.
  Vec3d At(double phi) const;
};

/// Numbers that are the same on every machine.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}
  /// Uniform in [low, high).
  double operator()(double low, double high);
  /// Uniform on the unit sphere.
  Vec3d Direction();
  /// A direction within the hemisphere about n (of any length), at least `sine` above its
  /// edge.
  Vec3d Above(Vec3d n, double sine = 0);
  /// A direction in the hemisphere about the unit vector n, exactly `sine` above its
  /// edge.
  Vec3d AtSine(Vec3d n, double sine);

 private:
  std::mt19937_64 engine_;
};

/// A point of SquareMesh (scene_text.h), clear of its rim.
Vec3d PointOfSquare(Draws& draws, Vec3d center, Vec3d n, double side = 1);

}  // namespace lanelight::stress
