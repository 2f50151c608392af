// What training passes find out of paths, and variances from their few samples.
#pragma once

#include <span>
#include <vector>

#include "src/render/train/training_pass.h"
#include "src/scene/prepare/estimate_path_values.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/sample_planes.h"

namespace lanelight {

/// What a recording pass knows of a sample (kernels/roulette/training_records.cc).
struct PathRecord {
  struct Vertex {
    std::uint32_t cell;
    float at, got;
  };
  Vertex vertices[kRecordedVertices];
  float end, depth;
  float risk[3];

  /// What roulette on the throughput would add to the square of `end`, on average; zero
  /// where rounding could have made it.
  double Risk() const {
    const double square = double{end} * end * risk[0];
    const double added = square - 2.0 * end * risk[1] + risk[2];
    return added > 1e-5 * square ? added : 0;
  }
};

struct PathSamples : TrainingSamples {
  std::vector<PathRecord> records;  // as many as colours, if the pass has recorded
};

/// Reads the planes of PlaneGroup::kRecord, if there are any.
PathSamples ReadRecords(TrainingSamples samples);

/// What the image is like, by the samples of `work`.
ImageGuess GuessImage(const PreparedScene& scene, const TrainingSamples& samples,
                      const TrainingWork& work);

/// Variance of the mean of some pixels of `work` (their places in it), of a sample in
/// each, as relative errors weigh it: of the means of observations, times the samples of
/// one.
double VarianceOfMean(const TrainingSamples& samples, const TrainingWork& work,
                      const ImageGuess& image, std::span<const std::size_t> places);

/// The same of each pixel by itself.
std::vector<double> RelativeVariances(const TrainingSamples& samples,
                                      const TrainingWork& work, const ImageGuess& image);

/// Variance with roulette on the throughput over that without, from the records of a pass
/// without (PathRecord::Risk); the worst thousandth of the pixels counts in neither.
double RouletteVarianceRatio(const PathSamples& samples, const TrainingWork& work,
                             const ImageGuess& image);

}  // namespace lanelight
