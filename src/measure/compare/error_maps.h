// Errors of each pixel, as pictures.
#pragma once

#include "src/measure/compare/linear_image.h"

namespace lanelight {

/// NaN where a value of either image is invalid.
struct ErrorMaps {
  Plane difference;  // (a - b) / sqrt(b^2 + kRelativeEpsilon), of the channels' means
  Plane relative;    // root of the mean of (a - b)^2 / (b^2 + kRelativeEpsilon)
  Plane absolute;    // root of the mean of (a - b)^2
};

ErrorMaps ErrorMapsOf(const LinearImage& test, const LinearImage& reference);

/// A number with one digit that all but one in fifty of |values| stay below: the end of a
/// colour scale that fits. 1 where all are zero, or none is finite.
double ScaleOf(const Plane& values);

}  // namespace lanelight
