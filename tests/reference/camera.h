// Camera rays and pixel filters of the reference tracer.
#pragma once

#include <optional>

#include "tests/reference/geometry.h"
#include "tests/reference/lenses.h"

namespace lanelight::reference {

/// Offset from the pixel centre along one axis, with density proportional to the filter.
/// Box, triangle and gaussian only (CheckFailure otherwise): the sample weight is 1.
double SampleFilter(const Filter& filter, double radius, Random& random);

/// A sample of the camera; `weight` 0: lenses have stopped it.
struct CameraSample {
  Ray ray;
  double weight = 1;
};

/// Rays through film position (x, y), in pixels from the upper left corner of the full
/// image: cameras as pbrt defines them.
class CameraRays {
 public:
  CameraRays(const Camera& camera, const Film& film);
  CameraSample Sample(double x, double y, Random& random) const;

 private:
  CameraSample Plane(double x, double y, Random& random) const;
  CameraSample Sphere(double x, double y) const;
  CameraSample Realistic(double x, double y, Random& random) const;
  CameraSample InWorld(Vec3d origin, Vec3d direction, double weight) const;

  const Camera& camera_;
  const Film& film_;
  std::optional<Lenses> lenses_;
};

/// The ray of a camera that stops none.
inline Ray CameraRay(const Camera& camera, const Film& film, double x, double y,
                     Random& random) {
  return CameraRays(camera, film).Sample(x, y, random).ray;
}

}  // namespace lanelight::reference
