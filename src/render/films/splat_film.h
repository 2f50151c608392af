// Light that light subpaths bring to pixels anywhere in the film (light-paths=splats):
// sums and sums of squares over subpaths, which are independent. They are integers, so
// that they do not depend on the order in which tasks end.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/column.h"
#include "src/base/core/vec.h"
#include "src/base/image/pixel_rect.h"

namespace lanelight {

/// Sums of light by channel and of its squares, in two integers each. Parts may be added
/// one by one: light is high * 2^-24 + low * 2^-64, a square high * 2^-16 + low * 2^-56.
struct SplatSums {
  static constexpr int kValues = 6;  // three channels, then their squares
  std::int64_t high[kValues] = {};
  std::int64_t low[kValues] = {};

  /// Adds light whose magnitude is below 2^17.
  void Add(const float light[3]);
  /// Makes `low` less than 2^39 in magnitude: then equal sums have equal parts.
  void Normalize();
  double Value(int i) const;
};

/// Light that one subpath adds to one pixel, in SplatFilm::unit(). The mean over
/// subpaths, times the number of pixels of the image, is the pixel's light.
struct PixelSplat {
  std::uint32_t pixel = 0;  // row by row in the film
  float light[3] = {};
};

class SplatFilm {
 public:
  /// `unit`: of the light that is added, in units of the film.
  SplatFilm(std::size_t pixels, double unit) : unit_(unit) {
    ResizeInHugePages(sums_, pixels);
  }
  static constexpr std::size_t BytesPerPixel() { return sizeof(SplatSums); }
  double unit() const { return unit_; }

  /// Adds the splats of so many subpaths. Safe from any thread.
  void Add(const std::vector<PixelSplat>& splats, std::uint64_t paths);

  /// Returns what subpaths bring to a pixel; zero without subpaths.
  Rgb Mean(std::size_t pixel) const;
  /// Returns the estimated variance of Mean.
  Rgb Variance(std::size_t pixel) const;

  /// Returns all sums, with equal parts if they are equal. Those of different subpaths
  /// add up.
  std::vector<MutableStateColumn> Columns();

 private:
  double unit_;
  std::vector<SplatSums> sums_;
  std::uint64_t paths_ = 0;  // that have started
  mutable std::mutex mutex_;
};

}  // namespace lanelight
