#include "tests/reference/camera.h"

#include "src/base/core/check.h"
#include "src/base/core/pi.h"
#include "src/base/image/octahedral.h"

namespace lanelight::reference {
namespace {

// Uniform in the unit disk, by rejection.
void SampleDisk(Random& random, double& x, double& y) {
  do {
    x = 2 * random.Uniform() - 1;
    y = 2 * random.Uniform() - 1;
  } while (x * x + y * y > 1);
}

}  // namespace

double SampleFilter(const Filter& filter, double radius, Random& random) {
  const double x = (2 * random.Uniform() - 1) * radius;
  switch (filter.kind) {
    case FilterKind::kBox:
      return x;
    case FilterKind::kTriangle:  // the sum of two boxes of half the width
      return (x + (2 * random.Uniform() - 1) * radius) / 2;
    case FilterKind::kGaussian: {
      // Rejection; the bell is lowered so that it reaches zero at the radius.
      const auto bell = [&](double v) {
        return std::exp(-v * v / (2 * filter.sigma * filter.sigma));
      };
      if (random.Uniform() * (1 - bell(radius)) < bell(x) - bell(radius)) return x;
      return SampleFilter(filter, radius, random);
    }
    case FilterKind::kMitchell:
    case FilterKind::kLanczos:
      break;
  }
  LL_CHECK(filter.kind <= FilterKind::kGaussian);
  return 0;
}

CameraRays::CameraRays(const Camera& camera, const Film& film)
    : camera_(camera), film_(film) {
  if (camera.kind == CameraKind::kRealistic) lenses_.emplace(camera);
}

CameraSample CameraRays::Sample(double x, double y, Random& random) const {
  if (camera_.kind == CameraKind::kSpherical) return Sphere(x, y);
  if (camera_.kind == CameraKind::kRealistic) return Realistic(x, y, random);
  return Plane(x, y, random);
}

CameraSample CameraRays::InWorld(Vec3d origin, Vec3d direction, double weight) const {
  return {{camera_.world_from_camera.Point(origin),
           Normalize(camera_.world_from_camera.Vector(direction)), kNone},
          weight};
}

// +y is up: the pole of longitudes, and of the octahedral map.
CameraSample CameraRays::Sphere(double x, double y) const {
  double s = x / film_.width, t = y / film_.height;
  if (camera_.mapping == SphericalMapping::kEqualArea) {
    // Where an edge is crossed at s, the way leads back in at 1 - s.
    if (s < 0 || s > 1) s = s < 0 ? -s : 2 - s, t = 1 - t;
    if (t < 0 || t > 1) t = t < 0 ? -t : 2 - t, s = 1 - s;
    const Vec3d d = OctahedralToDirection(s, t);
    return InWorld({}, {d.x, d.z, d.y}, 1);
  }
  const double theta = kPi * t, phi = 2 * kPi * s;
  return InWorld(
      {},
      {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)},
      1);
}

// Towards a point of the whole plane of the rear surface; the film is upside down.
CameraSample CameraRays::Realistic(double x, double y, Random& random) const {
  const double per_pixel = camera_.film_diagonal / std::hypot(film_.width, film_.height);
  const Vec3d film = {per_pixel * (film_.width / 2.0 - x),
                      per_pixel * (y - film_.height / 2.0), 0};
  const double side = 2 * 1.3 * lenses_->rear_radius();
  const Vec3d rear = {side * (random.Uniform() - 0.5), side * (random.Uniform() - 0.5),
                      lenses_->rear()};
  const auto ray = lenses_->Trace(film, rear);
  if (!ray) return {{}, 0};
  // Irradiance at the film: cos cos dA / distance^2.
  const double distance = Length(rear - film), cosine = rear.z / distance;
  const double weight = cosine * cosine * side * side / (distance * distance);
  return InWorld(ray->o / 1000, ray->d, weight);
}

// The shorter image axis spans [-1, 1] on a screen, times tan(fov / 2) at depth 1.
CameraSample CameraRays::Plane(double x, double y, Random& random) const {
  const Camera& camera = camera_;
  const Film& film = film_;
  const double aspect = camera.frame_aspect > 0
                            ? camera.frame_aspect
                            : static_cast<double>(film.width) / film.height;
  double window[4] = {-1, 1, -1, 1};
  if (aspect > 1) {
    window[0] = -aspect, window[1] = aspect;
  } else {
    window[2] = -1 / aspect, window[3] = 1 / aspect;
  }
  const auto& screen = camera.screen_window;
  if (screen[0] != 0 || screen[1] != 0 || screen[2] != 0 || screen[3] != 0) {
    std::copy(screen, screen + 4, window);
  }
  const double sx = window[0] + (window[1] - window[0]) * x / film.width;
  const double sy = window[3] - (window[3] - window[2]) * y / film.height;
  Vec3d origin, direction = {0, 0, 1};
  if (camera.kind == CameraKind::kPerspective) {
    const double scale = std::tan(camera.fov * kPi / 360);
    direction = {sx * scale, sy * scale, 1};
  } else {
    origin = {sx, sy, 0};
  }
  if (camera.lens_radius > 0) {
    // All rays of one film position meet at the depth of focus.
    const Vec3d focus = origin + camera.focal_distance * direction;
    double lx, ly;
    SampleDisk(random, lx, ly);
    origin += camera.lens_radius * Vec3d{lx, ly, 0};
    direction = focus - origin;
  }
  return InWorld(origin, direction, 1);
}

}  // namespace lanelight::reference
