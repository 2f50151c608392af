// Affine and projective 4x4 transforms in double precision, as the scene file states
// them. Points are columns: p' = M p.
#pragma once

#include <array>

#include "src/base/core/vec.h"

namespace lanelight {

class Transform {
 public:
  using Matrix = std::array<std::array<double, 4>, 4>;  // m[row][column]

  /// Identity.
  Transform();
  explicit Transform(const Matrix& m) : m_(m) {}

  static Transform Translate(Vec3d delta);
  static Transform Scale(Vec3d s);
  /// Rotation by `degrees` about `axis` (need not be unit length).
  static Transform Rotate(double degrees, Vec3d axis);
  /// Camera-from-world transform looking from `eye` to `look` (pbrt's left-handed
  /// convention: +x right, +y up, +z forward).
  static Transform LookAt(Vec3d eye, Vec3d look, Vec3d up);
  /// From 16 numbers in the column-major order of pbrt's `Transform` directive.
  static Transform FromPbrt(const std::array<double, 16>& values);

  const Matrix& matrix() const { return m_; }
  double operator()(int row, int column) const { return m_[row][column]; }

  /// Composition: (a * b) applies b first.
  friend Transform operator*(const Transform& a, const Transform& b);
  friend bool operator==(const Transform&, const Transform&) = default;

  Vec3d Point(Vec3d p) const;
  Vec3d Vector(Vec3d v) const;
  /// Normal transform, n' = M^-T n, not normalised. Uses the cofactor matrix, so it
  /// needs no inverse and keeps the sign of the determinant out of the direction.
  Vec3d Normal(Vec3d n) const;

  /// Determinant of the upper 3x3 block.
  double Determinant3() const;
  /// True if it mirrors space.
  bool SwapsHandedness() const { return Determinant3() < 0; }
  /// True if every entry is finite and the matrix can be inverted in double precision.
  bool IsInvertible() const;
  /// Requires IsInvertible().
  Transform Inverse() const;
  Transform Transposed() const;
  /// If the upper 3x3 block is s*R (R orthogonal, relative error below 1e-5), returns s;
  /// otherwise 0.
  double UniformScale() const;

 private:
  Matrix m_;
};

}  // namespace lanelight
