// The tables by which environment images are sampled.
#pragma once

#include "src/compiled/lights.h"

namespace lanelight {

/// Sets everything of `environment` that sampling reads (cumulative distributions,
/// guides, probabilities) from its size and radiance. Texels are chosen in proportion to
/// their luminance; `compensated`: to what it has above the mean over the sphere, as
/// where scattered rays are weighed against light samples and find the rest (Karlik, Sik,
/// Vevoda, Skrivan and Krivanek 2019, "MIS Compensation: Optimizing Sampling Techniques
/// in Multiple Importance Sampling"). An image that is the same everywhere, but for
/// rounding, has nothing above its mean and keeps the plain table. A black image gets
/// none.
void SetEnvironmentTable(bool compensated, Environment& environment);

}  // namespace lanelight
