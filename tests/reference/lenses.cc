#include "tests/reference/lenses.h"

#include <cmath>

#include "src/base/core/check.h"

namespace lanelight::reference {
namespace {

// The law of refraction in the plane of d and n, which faces the ray.
std::optional<Vec3d> Refracted(Vec3d d, Vec3d n, double eta_from, double eta_to) {
  const Vec3d along = d - n * Dot(d, n);  // of length sin of the angle
  const Vec3d bent = along * (eta_from / eta_to);
  const double sin2 = Dot(bent, bent);
  if (sin2 >= 1) return std::nullopt;
  return bent - n * std::sqrt(1 - sin2);
}

}  // namespace

Lenses::Lenses(const Camera& camera) {
  LL_CHECK(camera.aperture.empty());
  double z = 0;
  for (std::size_t row = camera.lens.size() / 4; row-- > 0;) {
    const double* values = &camera.lens[4 * row];
    z += values[1];
    const double before = row > 0 ? camera.lens[4 * row - 2] : 1;
    const double diameter =
        values[0] == 0 ? std::min(values[3], camera.aperture_diameter) : values[3];
    surfaces_.push_back({z, z - values[0], std::abs(values[0]),
                         values[2] == 0 ? 1 : values[2], before == 0 ? 1 : before,
                         diameter / 2});
  }
  // The farther the lenses are from the film, the nearer is what is in focus, down to
  // four focal lengths; beyond, the image would be larger than the object.
  const double wanted = camera.focal_distance * 1000, step = 0.05;
  const auto in_front = [&](double shift) {
    for (Surface& s : surfaces_) s.z += shift, s.center += shift;
    const double at = Crossing();
    for (Surface& s : surfaces_) s.z -= shift, s.center -= shift;
    return at > 0 && at < wanted;
  };
  double low = -surfaces_.front().z + 1e-6;
  while (!in_front(low + step)) {
    low += step;
    LL_CHECK(low < 10 * z);
  }
  double high = low + step;
  for (int i = 0; i < 60; ++i) {
    const double shift = (low + high) / 2;
    (in_front(shift) ? high : low) = shift;
  }
  for (Surface& s : surfaces_) s.z += low, s.center += low;
}

// Returns where a ray from the middle of the film returns to the axis; below 0: nowhere
// ahead.
double Lenses::Crossing() const {
  const auto ray = Trace({0, 0, 0}, {1e-4, 0, rear()});
  LL_CHECK(ray.has_value());
  if (!(ray->d.x < 0)) return -1;
  return ray->o.z - ray->o.x / ray->d.x * ray->d.z;
}

std::optional<Ray> Lenses::Trace(Vec3d from, Vec3d towards) const {
  Ray ray = {from, Normalize(towards - from), kNone};
  for (const Surface& s : surfaces_) {
    Vec3d at;
    if (s.radius == 0) {
      at = ray.o + ray.d * ((s.z - ray.o.z) / ray.d.z);
    } else {
      const Vec3d center = {0, 0, s.center}, to = center - ray.o;
      const double along = Dot(to, ray.d);
      const double half2 = s.radius * s.radius - (Dot(to, to) - along * along);
      if (half2 < 0) return std::nullopt;
      // The side of the sphere that the surface is: that of its own z.
      const double side = s.center > s.z ? -1 : 1;
      at = ray.o + ray.d * (along + side * std::sqrt(half2));
    }
    if (std::hypot(at.x, at.y) > s.half_diameter || Dot(at - ray.o, ray.d) < 0) {
      return std::nullopt;
    }
    ray.o = at;
    if (s.radius == 0) continue;
    Vec3d n = (at - Vec3d{0, 0, s.center}) / s.radius;
    if (Dot(n, ray.d) > 0) n = -n;
    const auto d = Refracted(ray.d, n, s.eta_film, s.eta_scene);
    if (!d) return std::nullopt;
    ray.d = *d;
  }
  return ray;
}

}  // namespace lanelight::reference
