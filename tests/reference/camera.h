// Camera rays and pixel filters of the reference tracer.
#pragma once

#include "tests/reference/geometry.h"

namespace lanelight::reference {

/// Offset from the pixel centre along one axis, with density proportional to the filter.
/// Box, triangle and gaussian only (CheckFailure otherwise): the sample weight is 1.
double SampleFilter(const Filter& filter, double radius, Random& random);

/// Ray through film position (x, y), in pixels from the upper left corner of the full
/// image. Perspective (with thin lens) and orthographic, as pbrt defines them.
Ray CameraRay(const Camera& camera, const Film& film, double x, double y, Random& random);

}  // namespace lanelight::reference
