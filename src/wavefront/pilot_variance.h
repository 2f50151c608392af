// Variances from the few samples of a pilot pass.
#pragma once

#include <vector>

#include "src/wavefront/pilot_pass.h"

namespace lanelight {

/// Variances of a sample in each pixel of `work`, as relative errors weigh them.
std::vector<double> RelativeVariances(const PilotSamples& samples, const PilotWork& work,
                                      const ImageGuess& image);

/// Mean without the worst thousandth.
double RobustMean(std::vector<double> values);

/// Variance with roulette on the throughput over that without, from the records of a pass
/// without (PilotRecord::Risk); the worst thousandth of the pixels counts in neither.
double RouletteVarianceRatio(const PilotSamples& samples, const PilotWork& work,
                             const ImageGuess& image);

}  // namespace lanelight
