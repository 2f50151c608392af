#include "src/measure/stress/cases/draws.h"

#include <cmath>

#include "src/base/core/pi.h"

namespace lanelight::stress {

Across::Across(Vec3d n) {
  const Vec3d other = std::abs(n.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  u = Normalize(Cross(n, other));
  v = Cross(n, u);
}

Vec3d Across::At(double phi) const { return std::cos(phi) * u + std::sin(phi) * v; }

double Draws::operator()(double low, double high) {
  const double unit = static_cast<double>(engine_() >> 11) * 0x1p-53;
  return low + (high - low) * unit;
}

Vec3d Draws::Direction() {
  const double z = (*this)(-1, 1), phi = (*this)(0, 2 * kPi);
  const double ring = std::sqrt(1 - z * z);
  return {ring * std::cos(phi), ring * std::sin(phi), z};
}

Vec3d Draws::Above(Vec3d n, double sine) {
  const double length = Length(n);
  for (;;) {
    const Vec3d d = Direction();
    const double cosine = Dot(d, n);
    if (std::abs(cosine) >= sine * length) return cosine > 0 ? d : -d;
  }
}

Vec3d Draws::AtSine(Vec3d n, double sine) {
  const Vec3d flat = Across(n).At((*this)(0, 2 * kPi));
  return std::sqrt(1 - sine * sine) * flat + sine * n;
}

Vec3d PointOfSquare(Draws& draws, Vec3d center, Vec3d n, double side) {
  const Across a(n);
  return center + (a.u * draws(-0.45, 0.45) + a.v * draws(-0.45, 0.45)) * side;
}

}  // namespace lanelight::stress
