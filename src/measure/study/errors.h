// Errors of one image against a reference.
#pragma once

#include <vector>

#include "src/measure/study/measurement.h"
#include "src/measure/study/reference.h"

namespace lanelight {

/// Fills in the errors and means of `m`. Squared errors are less the reference's own;
/// the MAPE is not, since absolute errors do not add up. The worst pixel is one of the
/// reference.
void MeasureErrors(const std::vector<Rgb>& image, const Reference& reference,
                   Measurement& m);

}  // namespace lanelight
