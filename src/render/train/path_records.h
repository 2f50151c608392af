// Records of paths in training passes, and variances from their few samples.
#pragma once

#include <span>
#include <vector>

#include "src/render/train/training_pass.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/run_parameters.h"

namespace lanelight {

/// The record of a sample (kernels/roulette/training_records.cc).
struct PathRecord {
  struct Vertex {
    std::uint32_t cell;
    float at, got;
    std::uint32_t light;  // that was sampled
    float direct;         // what it adds
  };
  Vertex vertices[kRecordedVertices];
  float end;
};

struct PathSamples : TrainingSamples {
  std::vector<PathRecord> records;  // as many as colours, if the pass has recorded
};

/// Reads the planes of PlaneGroup::kRecord, if there are any.
PathSamples ReadRecords(TrainingSamples samples);

/// Estimates the image from the samples of `work`.
PilotImage EstimatePilotImage(const PreparedScene& scene, const TrainingSamples& samples,
                              const TrainingWork& work);

/// Returns the variance of the mean of some pixels of `work` (their places in it), for
/// one sample in each, as relative errors weigh it: the variance of the means of
/// observations, times the samples of one.
double VarianceOfMean(const TrainingSamples& samples, const TrainingWork& work,
                      const PilotImage& image, std::span<const std::size_t> places);

/// Returns VarianceOfMean of each pixel by itself.
std::vector<double> RelativeVariances(const TrainingSamples& samples,
                                      const TrainingWork& work, const PilotImage& image);

/// Returns the value about which a pass with these values takes the moments of a pixel (y
/// * width + x), as radiance: its brightness, by PathValues::inverse_pixel.
double MomentsAbout(const PathValues& values, float exposure, std::uint32_t pixel);

/// Variances of a sample by pixel, as RelativeVariances has them for `samples`, of the
/// same strategy with roulette=throughput instead of splitting. `samples`: of a pass with
/// `values` that records single-path moments (Feature::kRecordsSinglePaths); `variances`:
/// its own.
///
/// The two differ by the second moments of independent samples: what stratified points
/// take off is variance of the mean given the first numbers of a path, which decisions on
/// its way leave as it is. A difference is taken to have the colour of the image. Results
/// of single pixels may be negative.
std::vector<double> SinglePathVariances(const TrainingSamples& samples,
                                        const TrainingWork& work, const PilotImage& image,
                                        const PathValues& values, float exposure,
                                        std::vector<double> variances);

}  // namespace lanelight
