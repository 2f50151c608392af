// Estimated coefficients of control=analytic and ambient: per pixel and channel,
// cross-fitted between two halves of the samples (film_control.h).
//
//   estimator   1/n (sum over half A of (f - c_B D) + sum over half B of (f - c_A D)),
//               D = h - E[h], c_X = Cov(f, D) / Var(D) from the observations of half X
//   unbiased    c_B is a function of samples that are independent of half A, so that
//               E[c_B D_A] = E[c_B] E[D_A] = 0. With c from the samples it multiplies,
//               E[c D] is of order (skewness) / n
//   variance    (1 - rho^2) (1 + O(1 / n)) of that without control
#pragma once

#include <cstdint>
#include <vector>

#include "src/image/film_control.h"

namespace lanelight {

/// Sums over observations of f and D.
struct ControlSums {
  double n = 0, f = 0, d = 0, ff = 0, fd = 0, dd = 0;
  void Add(double value, double difference) {
    n += 1;
    f += value;
    d += difference;
    ff += value * value;
    fd += value * difference;
    dd += difference * difference;
  }
};

/// Sums of squares and products about the means, which those of different pixels may be
/// added to.
struct ControlScatter {
  double freedom = 0;  // observations less one per mean
  double ff = 0, fd = 0, dd = 0;
  double square = 0;  // sum of f^2: the scale of f
  void Add(const ControlSums& sums);
  void Add(const ControlScatter& other);
  double Correlation() const;
};

/// Coefficient that makes f - c D vary least over the observations of `own`. `window`, of
/// these and of neighbouring pixels, weighs in: the neighbours with kNeighbourFreedom
/// degrees of freedom at most, so that few observations give no wild values. With r the
/// correlation and n the degrees of freedom, shrunk by max(0, 1 - 2 (1 - r^2) / (n r^2)):
/// what a fit to noise would gain is lost to others. 0 where D does not vary, save for
/// rounding (a standard deviation of 1e-5 of f). Limited to +-kMostCoefficient, which no
/// useful h needs: without it the coefficient of few samples has no finite mean.
double FitCoefficient(const ControlScatter& own, const ControlScatter& window);
inline constexpr double kNeighbourFreedom = 24;
inline constexpr double kMostCoefficient = 4;

/// One difference D per channel.
class ControlFilm final : public FilmControl {
 public:
  ControlFilm(int width, int height, const SampleGroups& groups);
  static std::size_t BytesPerPixel(const SampleGroups& groups);

  void Add(std::size_t pixel, const ControlledSamples& samples) override;
  void Fit(const ControlledColors& colors) override;
  Rgb Correction(std::size_t pixel, std::uint64_t samples) const override;
  void CorrectReplicates(std::size_t pixel, ReplicateSums& sums) const override;
  Rgb ResidualSquares(std::size_t pixel, std::uint64_t samples) const override;
  ControlReport Report(const ControlledColors& colors) const override;
  std::vector<MutableStateColumn> Columns() override;

 private:
  static constexpr int kReach = 2;  // window: 5 x 5 pixels
  struct Halves {
    ControlSums of[2][3];
  };
  struct Open {
    double f[3] = {}, d[3] = {};
  };
  struct Coefficients {
    float of[2][3] = {};  // fitted to this half, for the other one
  };
  ControlSums Sums(const ControlledColors& colors, std::size_t pixel, int half,
                   int channel) const;
  void FitRow(const ControlledColors& colors, int y);
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  SampleGroups groups_;
  std::vector<ReplicateSums> replicates_;  // of D; with replicates
  std::vector<Halves> halves_;             // units alternate between them; without
  std::vector<Open> open_;                 // of the incomplete unit; without
  std::vector<Coefficients> coefficients_;
};

}  // namespace lanelight
