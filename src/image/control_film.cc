#include "src/image/control_film.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

constexpr double kLeastSpread = 1e-5;  // standard deviation of D relative to f

}  // namespace

void ControlScatter::Add(const ControlSums& sums) {
  if (sums.n < 2) return;
  freedom += sums.n - 1;
  ff += std::max(0.0, sums.ff - sums.f * sums.f / sums.n);
  fd += sums.fd - sums.f * sums.d / sums.n;
  dd += std::max(0.0, sums.dd - sums.d * sums.d / sums.n);
  square += sums.ff;
}

double ControlScatter::Correlation() const {
  const double scale = std::sqrt(ff * dd);
  return scale > 0 ? fd / scale : 0;
}

double FitCoefficient(const ControlScatter& own, const ControlScatter& around) {
  const double weight =
      around.freedom > 0 ? std::min(1.0, kNeighbourFreedom / around.freedom) : 0;
  const double dd = own.dd + weight * around.dd;
  const double square = own.square + weight * around.square;
  if (!(dd > kLeastSpread * kLeastSpread * square)) return 0;
  const double c = (own.fd + weight * around.fd) / dd;
  return std::isfinite(c) ? std::clamp(c, -kMostCoefficient, kMostCoefficient) : 0;
}

ControlFilm::ControlFilm(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void ControlFilm::CloseGroup(std::size_t pixel, const double* means, std::uint32_t size) {
  Pixel& p = pixels_[pixel];
  for (int c = 0; c < 3; ++c) {
    p.halves[p.groups % 2][c].Add(means[c], p.open[c] / size);
    p.open[c] = 0;
  }
  ++p.groups;
}

double ControlFilm::Coefficient(std::size_t pixel, int half, int channel) const {
  ControlScatter own, around;
  const int x = static_cast<int>(pixel) % width_, y = static_cast<int>(pixel) / width_;
  for (int ny = std::max(0, y - 1); ny <= std::min(height_ - 1, y + 1); ++ny) {
    for (int nx = std::max(0, x - 1); nx <= std::min(width_ - 1, x + 1); ++nx) {
      const std::size_t i =
          static_cast<std::size_t>(ny) * static_cast<std::size_t>(width_) +
          static_cast<std::size_t>(nx);
      (i == pixel ? own : around).Add(pixels_[i].halves[half][channel]);
    }
  }
  return FitCoefficient(own, around);
}

Rgb ControlFilm::Correction(std::size_t pixel, std::uint32_t size) const {
  const Pixel& p = pixels_[pixel];
  Rgb sum;
  for (int c = 0; c < 3; ++c) {
    for (int half = 0; half < 2; ++half) {
      // An incomplete group belongs to the half that it would be in.
      const double open = half == static_cast<int>(p.groups % 2) ? p.open[c] : 0;
      sum[c] += Coefficient(pixel, 1 - half, c) * (p.halves[half][c].d * size + open);
    }
  }
  return sum;
}

Rgb ControlFilm::ResidualSquares(std::size_t pixel) const {
  const Pixel& p = pixels_[pixel];
  Rgb out;
  for (int c = 0; c < 3; ++c) {
    double sum = 0, squares = 0, n = 0;
    for (int half = 0; half < 2; ++half) {
      const ControlSums& s = p.halves[half][c];
      const double k = Coefficient(pixel, 1 - half, c);
      sum += s.f - k * s.d;
      squares += s.ff - 2 * k * s.fd + k * k * s.dd;
      n += s.n;
    }
    out[c] = n > 0 ? std::max(0.0, squares - sum * sum / n) : 0;
  }
  return out;
}

ControlReport ControlFilm::Report() const {
  ControlScatter total;
  double coefficients = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    for (int half = 0; half < 2; ++half) {
      for (int c = 0; c < 3; ++c) {
        total.Add(pixels_[i].halves[half][c]);
        coefficients += Coefficient(i, half, c);
      }
    }
  }
  return {coefficients / (6 * static_cast<double>(pixels_.size())), total.Correlation()};
}

}  // namespace lanelight
