// What a strategy that splits paths would have for variance without splitting, from its
// own training pass.
#pragma once

#include <vector>

#include "src/render/train/training_pass.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

/// About what a pass with these values takes the moments of a pixel (y * width + x), in
/// terms of radiance: its brightness, by PathValues::inverse_pixel.
double MomentsAbout(const PathValues& values, float exposure, std::uint32_t pixel);

/// Variances of a sample by pixel, as RelativeVariances has them for `samples`, of the
/// same strategy with roulette=throughput instead of splitting. `samples`: of a pass with
/// `values` that records single-path moments (Feature::kRecordsSinglePaths); `variances`:
/// its own.
///
/// The two differ by the second moments of independent samples: what stratified points
/// take off is variance of the mean given the first numbers of a path, which decisions on
/// its way leave as it is. A difference is taken to have the colour of the image. Of
/// single pixels the result may be negative.
std::vector<double> SinglePathVariances(const TrainingSamples& samples,
                                        const TrainingWork& work, const ImageGuess& image,
                                        const PathValues& values, float exposure,
                                        std::vector<double> variances);

}  // namespace lanelight
