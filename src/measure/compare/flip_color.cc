#include "src/measure/compare/flip_color.h"

#include <cmath>

namespace lanelight {
namespace {

// CIE 15: a cube root, with a straight line near black.
double LabCurve(double t) {
  constexpr double kDelta = 6.0 / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                      : t / (3 * kDelta * kDelta) + 4.0 / 29;
}

}  // namespace

OpponentColors::OpponentColors() : relative_(XyzFromSrgb()) {
  for (Vec3d& row : relative_.row) row = row / (row.x + row.y + row.z);
  inverse_ = Inverse(relative_);
}

Vec3d OpponentColors::FromRgb(Vec3d rgb) const {
  const Vec3d xyz = relative_ * rgb;
  return {xyz.y, xyz.x - xyz.y, xyz.y - xyz.z};
}

Vec3d OpponentColors::ToRgb(Vec3d opponent) const {
  const double y = opponent.x;
  return inverse_ * Vec3d{y + opponent.y, y, y - opponent.z};
}

Vec3d OpponentColors::HuntLab(Vec3d rgb) const {
  const Vec3d xyz = relative_ * rgb;
  const double x = LabCurve(xyz.x), y = LabCurve(xyz.y), z = LabCurve(xyz.z);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double HyAb(Vec3d a, Vec3d b) {
  const Vec3d d = a - b;
  return std::abs(d.x) + std::hypot(d.y, d.z);
}

}  // namespace lanelight
