// The denominator of relative errors.
#pragma once

namespace lanelight {

/// Added to the squared reference in relative squared errors, so that black pixels have
/// one, too (as pbrt's imgtool).
inline constexpr double kRelativeEpsilon = 0.01;

}  // namespace lanelight
