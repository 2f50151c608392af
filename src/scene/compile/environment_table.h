// The tables by which environment images are sampled.
#pragma once

#include "src/scene/compiled/lights.h"

namespace lanelight {

/// What texels of `environment` are sampled by: in proportion to
/// their luminance; `compensated`: to what it has above the mean over the sphere, as
/// where scattered rays are weighed against light samples and find the rest (Karlik, Sik,
/// Vevoda, Skrivan and Krivanek 2019, "MIS Compensation: Optimizing Sampling Techniques
/// in Multiple Importance Sampling"). An image that is the same everywhere, but for
/// rounding, has nothing above its mean and keeps the plain table. That of a black
/// image is empty.
std::shared_ptr<const EnvironmentTable> MakeEnvironmentTable(
    bool compensated, const Environment& environment);

}  // namespace lanelight
