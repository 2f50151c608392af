#include "src/scene/compile/tessellate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lanelight {
namespace {

// Width of a pixel on the image plane at distance 1, or of an orthographic image.
double PixelWidth(const Camera& camera, const Film& film) {
  const double* w = camera.screen_window;
  const bool has_window = w[0] != w[1] && w[2] != w[3];
  if (!has_window) return 2.0 / std::min(film.width, film.height);
  return std::min((w[1] - w[0]) / film.width, (w[3] - w[2]) / film.height);
}

double PixelSize(const Camera& camera, const Film& film, double distance) {
  const double half_view = camera.fov / 360 * std::numbers::pi;
  switch (camera.kind) {
    case CameraKind::kPerspective:
      return distance * std::tan(half_view) * PixelWidth(camera, film);
    case CameraKind::kOrthographic:
      return Length(camera.world_from_camera.Vector({1, 0, 0})) *
             PixelWidth(camera, film);
    case CameraKind::kSpherical:
    case CameraKind::kRealistic:
      break;
  }
  // Assumes a narrow view of 30 degrees for every lens.
  return distance * 0.5 / std::max(film.width, film.height);
}

double LargestScale(const Transform& t) {
  return std::max({Length(t.Vector({1, 0, 0})), Length(t.Vector({0, 1, 0})),
                   Length(t.Vector({0, 0, 1}))});
}

// Returns the distance of the eye from the surface of a ball around the shape.
double DistanceTo(const PlacedShape& placed, Vec3d eye) {
  const Shape& shape = *placed.shape;
  const bool has_length = shape.kind == ShapeKind::kCylinder;
  const double middle = has_length ? (shape.z_min + shape.z_max) / 2 : shape.height;
  const double reach = has_length ? (shape.z_max - shape.z_min) / 2 : 0;
  const double ball = std::hypot(shape.radius, reach) * LargestScale(placed.transform);
  return std::abs(Length(placed.transform.Point({0, 0, middle}) - eye) - ball);
}

}  // namespace

double CameraTolerance(const PlacedShape& placed, const Camera& camera,
                       const Film& film) {
  const double distance = DistanceTo(placed, camera.world_from_camera.Point({0, 0, 0}));
  const double radius = placed.shape->radius * LargestScale(placed.transform);
  const double seen = kTolerancePixels * PixelSize(camera, film, distance) / radius;
  const bool is_sphere = placed.shape->kind == ShapeKind::kSphere;
  const double finest = is_sphere ? kFinestSphere : kFinestCylinder;
  return seen > finest ? std::min(seen, kCoarsest) : finest;
}

}  // namespace lanelight
