// FLIP, written a second time as plainly as it can be: in double, without separable
// filters, from the equations of the papers.
#pragma once

#include <vector>

#include "src/measure/compare/linear_image.h"

namespace lanelight {

std::vector<double> PlainFlip(const LinearImage& reference, const LinearImage& test,
                              double pixels_per_degree);

/// The exponentiated and spread distance of two linear colours that fill all of an image.
double PlainColorError(const double (&a)[3], const double (&b)[3]);

}  // namespace lanelight
