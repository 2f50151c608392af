// The reference image of a study, with its own error, and errors of images against it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/core/vec.h"
#include "src/base/stat/hypothesis.h"
#include "src/measure/study/cell_store.h"
#include "src/render/job/job.h"

namespace lanelight {

struct Reference {
  int width = 0, height = 0;
  std::vector<Rgb> mean;      // rows from the top
  std::vector<Rgb> variance;  // of `mean`; empty if unknown
  std::vector<std::string> files;
  std::string strategy;   // of a rendered reference
  std::uint64_t spp = 0;  // of a rendered reference
  double seconds = 0;     // wall clock; 0 for files
  std::string note;

  bool rendered() const { return files.empty(); }
  bool has_variance() const { return !variance.empty(); }
  Rgb Variance(std::size_t pixel) const {
    return has_variance() ? variance[pixel] : Rgb{};
  }
  /// Returns the mean of the channels, assumed fully dependent, with one degree of
  /// freedom, since the number of samples behind the variance is unknown.
  stat::MeanEstimate GreyEstimate(std::size_t pixel) const;
  /// Returns 1 / (squared mean + 0.01) for each channel.
  Rgb Weight(std::size_t pixel) const;
  /// Return the estimated absolute and relative MSE of the reference; 0 if unknown.
  double OwnMse() const;
  double OwnRelMse() const;
};

/// Reads a reference for a crop window of a film. Each file has the size of the window or
/// of the film. Several files are independent renders: the reference is their mean, with
/// the variance of their scatter. A single file may have variance channels. Throws
/// InputError for files that are unreadable, of another size, without colour, or not
/// finite.
Reference ReadReference(const std::vector<std::string>& files, const PixelRect& window,
                        int full_width, int full_height);

struct ReferenceOptions {
  std::uint64_t spp = 1, seed = 0;
  /// State file (docs/state.md), written once a minute and when stopped. Resumes from an
  /// existing file and keeps it. May be empty.
  std::string state;
  std::function<void(const Progress&)> on_progress;
  std::function<void(const std::string&)>
      on_problem;                           // for state files that cannot be written
  const std::atomic<bool>* stop = nullptr;  // as in RunOptions
};

/// Renders a reference with the independent sampler, which shares no samples with tested
/// strategies, and its own seed. The result is unusable if stopped; a resumed render is
/// bit-identical. Throws InputError if the state is damaged, or of another render.
Reference RenderReference(const Job& job, const ReferenceOptions& options);

/// Writes an EXR file with variance channels. Mean and variance are floats already, so
/// that reading them returns the same values.
void WriteReference(const std::string& path, const Reference& reference);

/// Sets the errors and means of `m`. Squared errors exclude the reference's own error;
/// the MAPE includes it, since absolute errors do not add up. The worst pixel is relative
/// to the reference image.
void MeasureErrors(const std::vector<Rgb>& image, const Reference& reference,
                   Measurement& m);

}  // namespace lanelight
