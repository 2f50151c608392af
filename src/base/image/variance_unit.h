// Variances in images of 32-bit numbers. Those of a radiance of 1e20 and more, or of
// 1e-20 and less, would be infinite or zero there: then the channels hold them in another
// unit, a power of two that an attribute of the file names. Ordinary images have no such
// attribute.
#pragma once

#include "src/base/image/image.h"

namespace lanelight {

/// An int: a variance is the value of its channel times 2 to this power.
inline constexpr const char* kVarianceExponent = "varianceExponent";

/// An int: independent observations that the variance of a pixel rests on, of the pixel
/// that has the fewest.
inline constexpr const char* kObservations = "observations";

/// A float above 1, where pixels have paths in common: the sum over all pixels of the
/// squared correlation of their errors with one's own (SampleGroups::dependents).
inline constexpr const char* kDependentPixels = "dependentPixels";

/// An int above 0: pixels that have no sample and are black.
inline constexpr const char* kEmptyPixels = "emptyPixels";

/// The power to write with, where the largest finite variance of the image is `largest`;
/// 0 for 0 and for 1e-18 to 8e37. Beyond that (radiance is float: up to 1e-90 and 1e77)
/// the largest one comes to lie near the upper end of the range, so that as many of the
/// others as possible stay above zero.
int VarianceExponent(double largest);

/// Returns the factor of the variances of an image that was read.
double VarianceUnit(const Image& image);

}  // namespace lanelight
