// Images of the synthetic study.
#pragma once

#include <string>

#include "src/measure/report/page.h"

namespace lanelight {

inline constexpr int kSyntheticWidth = 96, kSyntheticHeight = 72;

/// A lit ball in a room, without noise.
ReportImage SyntheticReference(const std::string& name);

/// The reference with noise of relative standard deviation `noise` and relative bias
/// `bias` in the lower right.
ReportImage SyntheticRender(const std::string& name, double noise, double bias, int seed);

/// The variance of such a render.
ReportImage SyntheticVariance(const std::string& name, double noise);

/// Mean of `repetitions` such renders less the reference.
ReportImage SyntheticBias(const std::string& name, double noise, double bias, int seed);

/// Uniform in [0, 1), by a hash of the arguments.
double SyntheticRandom(int seed, int index);

}  // namespace lanelight
