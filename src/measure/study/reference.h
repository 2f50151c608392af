// The image that a study measures errors against, with what is known of its own error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/core/vec.h"
#include "src/base/stat/hypothesis.h"
#include "src/render/job/job.h"

namespace lanelight {

struct Reference {
  int width = 0, height = 0;
  std::vector<Rgb> mean;      // rows from the top
  std::vector<Rgb> variance;  // of `mean`; empty: not known
  std::vector<std::string> files;
  std::string strategy;   // of a rendered one
  std::uint64_t spp = 0;  // of a rendered one
  double seconds = 0;     // wall clock; 0 if it was read
  std::string note;

  bool rendered() const { return files.empty(); }
  bool has_variance() const { return !variance.empty(); }
  Rgb Variance(std::size_t pixel) const {
    return has_variance() ? variance[pixel] : Rgb{};
  }
  /// Mean of the channels, which are taken as fully dependent. How many of its samples
  /// found what makes its variance is not known: one degree of freedom.
  stat::MeanEstimate GreyEstimate(std::size_t pixel) const;
  /// 1 / (squared mean + 0.01), per channel.
  Rgb Weight(std::size_t pixel) const;
  /// Estimated mean squared error of the reference itself, absolute and relative; 0 if
  /// not known.
  double OwnMse() const;
  double OwnRelMse() const;
};

/// Reads a reference for the window of a film of full_width x full_height pixels: each
/// file has the size of either. Several files are independent renders of the same image:
/// their mean is the reference and their scatter its variance. A single file brings its
/// own variance channels, or none. Throws InputError: unreadable, of another size,
/// without colour, with values that are not finite.
Reference ReadReference(const std::vector<std::string>& files, const PixelRect& window,
                        int full_width, int full_height);

struct ReferenceOptions {
  std::uint64_t spp = 1, seed = 0;
  /// File that keeps the render's state (docs/state.md) once a minute, and when it is
  /// stopped; it goes on from one that is there, and leaves it behind. Empty: none.
  std::string state;
  std::function<void(const Progress&)> on_progress;
  std::function<void(const std::string&)> on_problem;  // a state that cannot be written
  const std::atomic<bool>* stop = nullptr;             // as in RunOptions
};

/// Renders one: independent points, which no low-discrepancy sampler under test shares,
/// with a seed of its own. Leaves the job with that strategy. If it was stopped, the
/// result is unusable. The same pixels whether it was stopped in between or not. Throws
/// InputError if the state is damaged, or of another render.
Reference RenderReference(const Job& job, const ReferenceOptions& options);

/// The same without a state.
inline Reference RenderReference(const Job& job, std::uint64_t spp, std::uint64_t seed,
                                 const std::function<void(const Progress&)>& on_progress,
                                 const std::atomic<bool>* stop) {
  return RenderReference(job, {spp, seed, "", on_progress, {}, stop});
}

/// As an EXR file with variance channels; mean and variance are floats, so that what is
/// read back is the same.
void WriteReference(const std::string& path, const Reference& reference);

}  // namespace lanelight
