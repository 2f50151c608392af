// Small windows of an image, rendered with several strategies, and their errors.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

#include "src/render/job.h"
#include "src/advise/halving.h"

namespace lanelight {

/// Square windows spread evenly over a window of the image: the cells of
/// a grid, in the order of a two-dimensional additive recurrence (the golden ratio's
/// generalisation, Roberts 2018), so that any number of consecutive ones covers it.
class WindowSequence {
 public:
  /// `side` pixels wide, or less where the image is smaller.
  explicit WindowSequence(const PixelRect& image, int side = 8);
  /// The next `count`; cells repeat once all have been given about once.
  std::vector<PixelRect> Next(std::size_t count);

 private:
  PixelRect image_;
  int side_, columns_, rows_;
  std::uint64_t index_ = 0;
};

/// Samples of a window, whatever its shape.
inline constexpr double kWindowSamples = 8 * 8 * 128;

/// Samples per pixel of windows that stand for a render of so many: 128 (8 x 8 pixels),
/// 512 (4 x 4) or 2048 (2 x 2), not more than the render if it has 128. A strategy's
/// samples come in four randomisations, and what strata gain within one grows with its
/// length: shorter ones would favour what spoils strata and is cheap.
std::uint64_t WindowSpp(double render_spp);

/// Renders windows with strategies of the job's scene.
class WindowRenderer {
 public:
  /// `strategies` by index; all must be such that the scene takes them. `spp`: of
  /// WindowSpp.
  WindowRenderer(Job& job, std::vector<Strategy> strategies,
                 const std::atomic<bool>* stop, std::uint64_t spp = 128);

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
  /// `planned`: windows of the round.
  Rendered Render(const Strategy& strategy, const std::vector<PixelRect>& windows,
                  std::size_t planned);

  Job& job_;
  std::vector<Strategy> strategies_;
  const std::atomic<bool>* stop_;
  std::uint64_t spp_;
  WindowSequence sequence_;
  std::uint64_t seed_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace lanelight
