// Small windows of an image, rendered with several strategies, and their errors.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

#include "src/render/job.h"
#include "src/advise/halving.h"

namespace lanelight {

/// Windows of at most 8 x 8 pixels spread evenly over a window of the image: the cells of
/// a grid, in the order of a two-dimensional additive recurrence (the golden ratio's
/// generalisation, Roberts 2018), so that any number of consecutive ones covers it.
class WindowSequence {
 public:
  explicit WindowSequence(const PixelRect& image);
  /// The next `count`; cells repeat once all have been given about once.
  std::vector<PixelRect> Next(std::size_t count);

 private:
  PixelRect image_;
  int side_, columns_, rows_;
  std::uint64_t index_ = 0;
};

/// Samples of a window of 8 x 8 pixels.
inline constexpr double kWindowSamples = 8 * 8 * 128;

/// Renders windows with strategies of the job's scene. A window of 8 x 8 pixels has 128
/// samples per pixel, in four randomisations of 32: what strata gain beyond that is not
/// seen.
class WindowRenderer {
 public:
  /// `strategies` by index; all must be such that the scene takes them.
  WindowRenderer(Job& job, std::vector<Strategy> strategies,
                 const std::atomic<bool>* stop);

  /// As MeasureRound asks, in four to eight batches. Errors are estimated variances
  /// relative to the squared mean of the pixel over all candidates of the round +
  /// kRelativeEpsilon. `elapsed`: wall clock since the previous round, so that what is
  /// done with its results counts too.
  std::vector<WindowErrors> operator()(const std::vector<std::size_t>& candidates,
                                       std::size_t windows, double& elapsed);

 private:
  struct Rendered {
    std::vector<double> mean, variance;  // by window, pixel and channel
    std::vector<double> seconds;         // by window
    std::vector<std::size_t> batch;
  };
  /// With one of the strategies. `planned`: windows of the round.
  Rendered Render(std::size_t strategy, const std::vector<PixelRect>& windows,
                  std::size_t planned);
  /// Renders windows side by side; returns the processor time that it took, without
  /// pilots.
  double RunWindows(const Plan& plan, const std::vector<PixelRect>& windows,
                    std::uint64_t spp, std::uint64_t planned_samples,
                    FilmAccumulator& film);
  FilmAccumulator FilmOf(const std::vector<PixelRect>& windows) const;

  Job& job_;
  std::vector<Strategy> strategies_;
  const std::atomic<bool>* stop_;
  WindowSequence sequence_;
  std::uint64_t seed_;
  std::vector<double>
      set_up_;  // seconds of a run that renders next to nothing; the least
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace lanelight
