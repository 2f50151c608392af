// The fit of control=regression (kernels/control/regression.cc): polynomials in the
// numbers of the first bounce, fitted to what the pixel's neighbourhood has seen so far,
// are subtracted from later samples.
//
// Functions phi_j, orthonormal over uniform numbers: P1 and P2 of four numbers, P1 of the
// two coordinates in the pixel. Least squares then is b_j = s r_j, s the deviation of f
// and r_j = mean((f - mean f) phi_j) / s its correlation with phi_j. The correlation is
// averaged over the neighbourhood and shrunk by max(0, 1 - 1 / (n r_j^2)); the deviation
// is the pixel's own, but at most twice the neighbourhood's. (Averaging b_j would spread
// a bright pixel's noise to its dark neighbours.)
//
// Two halves of the samples, units (or replicates: src/path/replicates.h) in turns, are
// independent of each other, and each is corrected by what the other one says: E[b phi] =
// E[b] E[phi] = 0. Samples of the same replicate depend on each other, however far apart.
// Fits come at fixed numbers of samples, and end with kMostFitted of them: sums in single
// precision are good enough for as many, and nothing more is to be learned.
#pragma once

#include <cstdint>
#include <vector>

#include "src/image/control_film.h"

namespace lanelight {

/// Consecutive samples of the pixels of a rectangle [x0, x1) x [y0, y1).
struct SampleBlock {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  const std::uint32_t* pixels = nullptr;  // y * image_width + x, in order of the samples
  std::uint32_t num_pixels = 0, image_width = 0;
  float* values = nullptr;  // plane-major; a pixel's samples are consecutive
  std::uint32_t count = 0;  // samples per pixel

  float* At(int plane, std::uint32_t pixel) const {
    return values + static_cast<std::size_t>(plane) * num_pixels * std::size_t{count} +
           std::size_t{pixel} * count;
  }
};

class RegressionFilm {
 public:
  static constexpr int kPlanes = 6;  // four numbers (-1 = none), position in the pixel
  static constexpr int kFunctions = 10;
  static constexpr int kReach = 2;  // neighbourhood: 5 x 5 pixels of the same block
  /// Pixels know of each other within blocks of so many squared, from the image's origin
  /// on: how a render is cut must not matter.
  static constexpr int kBlock = 16;
  static constexpr std::uint64_t kMostFitted = std::uint64_t{1} << 20;

  RegressionFilm(int x0, int y0, int width, int height, const SampleGroups& groups,
                 double coefficient);
  static std::size_t BytesPerPixel();

  /// Corrects the colours in place. `first_plane`: of the kPlanes numbers. Rectangles
  /// hold whole blocks, as far as these are rendered, and each is given its samples in
  /// order; safe for different ones from different threads.
  void Correct(const SampleBlock& block, int first_plane);

  /// Values of the functions at six numbers.
  static void Functions(const float* numbers, float* phi);
  ControlReport Report() const;

  /// All that Correct has brought.
  std::vector<MutableStateColumn> Columns();

 private:
  // Of one half of a pixel's samples, the first kMostFitted of them.
  struct Moments {
    double f[3] = {}, ff[3] = {};
  };
  struct Half {
    float phi[kFunctions] = {}, products[3][kFunctions] = {};
  };
  struct Pixel {
    Moments moments[2];
    double fitted = 0, fitted_squares = 0;  // sums of f times the fit, and of its square
  };
  struct Fits {
    Half sums[2];
    float b[2][3][kFunctions] = {};  // from this half, for the other one
  };
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y - y0_) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x - x0_);
  }
  int HalfOf(std::uint64_t sample) const {
    return static_cast<int>(sample / groups_.unit % 2);
  }
  void FitAll(const SampleBlock& block, std::uint64_t samples);
  void FitBlock(int x0, int y0, int x1, int y1, int half, double n);
  void Correlate(std::size_t pixel, int half, double n, float* out) const;
  void SetCoefficients(std::size_t pixel, int half, const float* sums, double n,
                       int window);
  void CorrectPixel(const SampleBlock& block, int first_plane, std::uint32_t pixel,
                    std::uint32_t begin, std::uint32_t end);

  int x0_, y0_, width_;
  SampleGroups groups_;
  double coefficient_;
  std::vector<std::uint64_t> samples_;
  std::vector<Pixel> pixels_;
  std::vector<Fits> fits_;
};

}  // namespace lanelight
