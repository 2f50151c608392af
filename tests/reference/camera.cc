#include "tests/reference/camera.h"

#include <numbers>

#include "src/core/check.h"

namespace lanelight::reference {
namespace {

constexpr double kPi = std::numbers::pi;

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

// The shorter image axis spans [-1, 1] on a screen, times tan(fov / 2) at depth 1.
Ray CameraRay(const Camera& camera, const Film& film, double x, double y,
              Random& random) {
  const double aspect = camera.frame_aspect > 0
                            ? camera.frame_aspect
                            : static_cast<double>(film.width) / film.height;
  double window[4] = {-1, 1, -1, 1};
  if (aspect > 1) {
    window[0] = -aspect, window[1] = aspect;
  } else {
    window[2] = -1 / aspect, window[3] = 1 / aspect;
  }
  const auto& given = camera.screen_window;
  if (given[0] != 0 || given[1] != 0 || given[2] != 0 || given[3] != 0) {
    std::copy(given, given + 4, window);
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
  return {camera.world_from_camera.Point(origin),
          Normalize(camera.world_from_camera.Vector(direction)), kNone};
}

}  // namespace lanelight::reference
