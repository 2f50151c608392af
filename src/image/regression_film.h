// The fit of control=regression (kernels/control/regression.cc): polynomials in the
// numbers of the first bounce, fitted to what the pixel's neighbourhood has seen so far,
// are subtracted from later samples.
//
// Functions phi_j, orthonormal over uniform numbers: P1 and P2 of four numbers, P1 of the
// two coordinates in the pixel. Least squares then is b_j = s r_j, s the deviation of f
// and r_j = mean((f - mean f) phi_j) / s its correlation with phi_j. The correlation is
// averaged over the neighbourhood and shrunk by max(0, 1 - 1 / (n r_j^2)); the deviation
// is the pixel's own, but at most twice the neighbourhood's. (Averaging b_j would spread
// a bright pixel's noise to its dark neighbours.) Coefficients change only between groups
// of samples, and only depend on groups that were complete before: E[b phi | what came
// before] = b E[phi] = 0.
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
  static constexpr int kReach = 2;  // neighbourhood: 5 x 5 pixels of the rectangle

  RegressionFilm(int x0, int y0, int width, int height, std::uint32_t group_size,
                 double coefficient);
  static std::size_t BytesPerPixel() { return sizeof(Pixel); }
  /// Before the first fit: groups have another size.
  void Regroup(std::uint32_t group_size);

  /// Corrects the colours in place. `first_plane`: of the kPlanes numbers. Rectangles
  /// must be the same in every call, and each be given its samples in order; safe for
  /// different ones from different threads.
  void Correct(const SampleBlock& block, int first_plane);

  /// Values of the functions at six numbers.
  static void Functions(const float* numbers, float* phi);
  ControlReport Report() const;

  // As FilmAccumulator's.
  void Save(StateWriter& state) const;
  void Restore(StateReader& state);

 private:
  struct Pixel {
    double f[3] = {}, ff[3] = {};
    float phi[kFunctions] = {}, products[3][kFunctions] = {};
    float b[3][kFunctions] = {};
    float fitted = 0, fitted_squares = 0;  // of f and the fit, and of the fit
    std::uint32_t samples = 0, next_fit = 0;
  };
  Pixel& At(int x, int y) {
    return pixels_[static_cast<std::size_t>(y - y0_) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x - x0_)];
  }
  void Fit(const SampleBlock& block);
  static void Correlate(const Pixel& p, float* out);
  static void SetCoefficients(Pixel& p, const float* sums, int window);
  void CorrectPixel(const SampleBlock& block, int first_plane, std::uint32_t pixel,
                    std::uint32_t begin, std::uint32_t end);
  std::uint32_t NextFit(std::uint32_t samples) const;

  int x0_, y0_, width_;
  std::uint32_t block_ = 1;  // least samples between fits: whole groups
  double coefficient_;
  std::vector<Pixel> pixels_;
};

}  // namespace lanelight
