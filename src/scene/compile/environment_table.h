// The tables by which environment images are sampled.
#pragma once

#include "src/scene/compiled/lights.h"

namespace lanelight {

/// Makes the table by which texels of `environment` are sampled: in proportion to their
/// luminance, or with `compensated` to its excess over the mean. BSDF samples then find
/// the rest (Karlik, Sik, Vevoda, Skrivan and Krivanek 2019, "MIS Compensation:
/// Optimizing Sampling Techniques in Multiple Importance Sampling"). A constant image has
/// no excess and keeps the plain table. The table of a black image is empty.
std::shared_ptr<const EnvironmentTable> MakeEnvironmentTable(
    bool compensated, const Environment& environment);

}  // namespace lanelight
