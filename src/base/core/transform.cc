#include "src/base/core/transform.h"

#include <numbers>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// Gauss-Jordan elimination with full row pivoting. Returns false if singular.
bool Invert(Transform::Matrix a, Transform::Matrix& inverse) {
  inverse = Transform().matrix();
  for (int column = 0; column < 4; ++column) {
    int pivot = column;
    for (int row = column + 1; row < 4; ++row) {
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    }
    const double p = a[pivot][column];
    if (p == 0 || !std::isfinite(p) || !std::isfinite(1 / p)) return false;
    std::swap(a[pivot], a[column]);
    std::swap(inverse[pivot], inverse[column]);
    for (int j = 0; j < 4; ++j) {
      a[column][j] /= p;
      inverse[column][j] /= p;
    }
    for (int row = 0; row < 4; ++row) {
      if (row == column) continue;
      const double f = a[row][column];
      for (int j = 0; j < 4; ++j) {
        a[row][j] -= f * a[column][j];
        inverse[row][j] -= f * inverse[column][j];
      }
    }
  }
  for (const auto& row : inverse) {
    for (double value : row) {
      if (!std::isfinite(value)) return false;
    }
  }
  return true;
}

}  // namespace

Transform::Transform() : m_{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}} {}

Transform Transform::Translate(Vec3d d) {
  return Transform({{{1, 0, 0, d.x}, {0, 1, 0, d.y}, {0, 0, 1, d.z}, {0, 0, 0, 1}}});
}

Transform Transform::Scale(Vec3d s) {
  return Transform({{{s.x, 0, 0, 0}, {0, s.y, 0, 0}, {0, 0, s.z, 0}, {0, 0, 0, 1}}});
}

Transform Transform::Rotate(double degrees, Vec3d axis) {
  const Vec3d a = Normalize(axis);
  const double radians = degrees * (std::numbers::pi / 180);
  const double s = std::sin(radians), c = std::cos(radians), t = 1 - c;
  return Transform(
      {{{a.x * a.x * t + c, a.x * a.y * t - a.z * s, a.x * a.z * t + a.y * s, 0},
        {a.x * a.y * t + a.z * s, a.y * a.y * t + c, a.y * a.z * t - a.x * s, 0},
        {a.x * a.z * t - a.y * s, a.y * a.z * t + a.x * s, a.z * a.z * t + c, 0},
        {0, 0, 0, 1}}});
}

Transform Transform::LookAt(Vec3d eye, Vec3d look, Vec3d up) {
  const Vec3d forward = Normalize(look - eye);
  const Vec3d right = Normalize(Cross(Normalize(up), forward));
  const Vec3d true_up = Cross(forward, right);
  const Transform world_from_camera({{{right.x, true_up.x, forward.x, eye.x},
                                      {right.y, true_up.y, forward.y, eye.y},
                                      {right.z, true_up.z, forward.z, eye.z},
                                      {0, 0, 0, 1}}});
  return world_from_camera.Inverse();
}

Transform Transform::FromPbrt(const std::array<double, 16>& v) {
  Matrix m;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) m[row][column] = v[column * 4 + row];
  }
  return Transform(m);
}

Transform operator*(const Transform& a, const Transform& b) {
  Transform::Matrix m{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) m[i][j] += a.m_[i][k] * b.m_[k][j];
    }
  }
  return Transform(m);
}

Vec3d Transform::Point(Vec3d p) const {
  const auto row = [&](int i) {
    return m_[i][0] * p.x + m_[i][1] * p.y + m_[i][2] * p.z + m_[i][3];
  };
  const Vec3d q = {row(0), row(1), row(2)};
  const double w = row(3);
  return w == 1 ? q : q / w;
}

Vec3d Transform::Vector(Vec3d v) const {
  const auto row = [&](int i) {
    return m_[i][0] * v.x + m_[i][1] * v.y + m_[i][2] * v.z;
  };
  return {row(0), row(1), row(2)};
}

Vec3d Transform::Normal(Vec3d n) const {
  const Vec3d r0 = {m_[0][0], m_[0][1], m_[0][2]};
  const Vec3d r1 = {m_[1][0], m_[1][1], m_[1][2]};
  const Vec3d r2 = {m_[2][0], m_[2][1], m_[2][2]};
  const Vec3d c0 = Cross(r1, r2), c1 = Cross(r2, r0), c2 = Cross(r0, r1);
  const Vec3d out = {Dot(c0, n), Dot(c1, n), Dot(c2, n)};
  return SwapsHandedness() ? -out : out;
}

double Transform::Determinant3() const {
  const Vec3d r0 = {m_[0][0], m_[0][1], m_[0][2]};
  const Vec3d r1 = {m_[1][0], m_[1][1], m_[1][2]};
  const Vec3d r2 = {m_[2][0], m_[2][1], m_[2][2]};
  return Dot(r0, Cross(r1, r2));
}

bool Transform::IsInvertible() const {
  Matrix inverse;
  return Invert(m_, inverse);
}

Transform Transform::Inverse() const {
  Matrix inverse;
  LL_CHECK(Invert(m_, inverse));
  return Transform(inverse);
}

Transform Transform::Transposed() const {
  Matrix m;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) m[i][j] = m_[j][i];
  }
  return Transform(m);
}

double Transform::UniformScale() const {
  const Vec3d c0 = Vector({1, 0, 0}), c1 = Vector({0, 1, 0}), c2 = Vector({0, 0, 1});
  const double s = Length(c0);
  const double tolerance = 1e-5 * s;
  const bool same =
      std::abs(Length(c1) - s) <= tolerance && std::abs(Length(c2) - s) <= tolerance;
  const bool orthogonal = std::abs(Dot(c0, c1)) <= tolerance * s &&
                          std::abs(Dot(c1, c2)) <= tolerance * s &&
                          std::abs(Dot(c2, c0)) <= tolerance * s;
  return same && orthogonal ? s : 0;
}

}  // namespace lanelight
