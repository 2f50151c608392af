#include "src/image/control_film.h"

#include <algorithm>
#include <cmath>

#include "src/core/parallel.h"

namespace lanelight {
namespace {

constexpr double kLeastSpread = 1e-5;  // standard deviation of D relative to f
constexpr double kCaution = 2;         // see FitCoefficient

}  // namespace

void ControlScatter::Add(const ControlSums& sums) {
  if (sums.n < 2) return;
  freedom += sums.n - 1;
  ff += std::max(0.0, sums.ff - sums.f * sums.f / sums.n);
  fd += sums.fd - sums.f * sums.d / sums.n;
  dd += std::max(0.0, sums.dd - sums.d * sums.d / sums.n);
  square += sums.ff;
}

void ControlScatter::Add(const ControlScatter& other) {
  freedom += other.freedom;
  ff += other.ff;
  fd += other.fd;
  dd += other.dd;
  square += other.square;
}

double ControlScatter::Correlation() const {
  const double scale = std::sqrt(ff * dd);
  return scale > 0 ? fd / scale : 0;
}

double FitCoefficient(const ControlScatter& own, const ControlScatter& window) {
  const double around = window.freedom - own.freedom;
  const double weight = around > 0 ? std::min(1.0, kNeighbourFreedom / around) : 0;
  const auto mix = [&](double of_own, double of_window) {
    return (1 - weight) * of_own + weight * of_window;
  };
  const double dd = mix(own.dd, window.dd), fd = mix(own.fd, window.fd);
  const double square = mix(own.square, window.square);
  if (!(dd > kLeastSpread * kLeastSpread * square)) return 0;
  const double explained = fd * fd / dd;  // r^2 ff
  const double noise =
      kCaution * (mix(own.ff, window.ff) - explained) / mix(own.freedom, window.freedom);
  if (!(explained > noise)) return 0;
  const double c = fd / dd * std::min(1.0, 1 - noise / explained);
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

void ControlFilm::Regroup(std::uint32_t size) {
  for (Pixel& p : pixels_) {
    for (int c = 0; c < 3; ++c) {
      for (auto& half : p.halves) {
        p.open[c] += half[c].d * size;
        half[c] = {};
      }
    }
    p.groups = 0;
  }
}

void ControlFilm::FitRow(int y) {
  const int y0 = std::max(0, y - kReach), y1 = std::min(height_, y + kReach + 1);
  std::vector<ControlScatter> columns(static_cast<std::size_t>(width_));
  for (int half = 0; half < 2; ++half) {
    for (int c = 0; c < 3; ++c) {
      for (int x = 0; x < width_; ++x) {
        ControlScatter& column = columns[static_cast<std::size_t>(x)];
        column = {};
        for (int ny = y0; ny < y1; ++ny) {
          column.Add(pixels_[Index(x, ny)].halves[half][c]);
        }
      }
      for (int x = 0; x < width_; ++x) {
        ControlScatter own, window;
        own.Add(pixels_[Index(x, y)].halves[half][c]);
        const int x1 = std::min(width_, x + kReach + 1);
        for (int nx = std::max(0, x - kReach); nx < x1; ++nx) {
          window.Add(columns[static_cast<std::size_t>(nx)]);
        }
        pixels_[Index(x, y)].coefficients[half][c] =
            static_cast<float>(FitCoefficient(own, window));
      }
    }
  }
}

void ControlFilm::Fit() {
  ParallelFor(static_cast<std::size_t>(height_),
              [&](std::size_t y) { FitRow(static_cast<int>(y)); });
}

Rgb ControlFilm::Correction(std::size_t pixel, std::uint32_t size) const {
  const Pixel& p = pixels_[pixel];
  Rgb sum;
  for (int c = 0; c < 3; ++c) {
    for (int half = 0; half < 2; ++half) {
      // An incomplete group belongs to the half that it would be in.
      const double open = half == static_cast<int>(p.groups % 2) ? p.open[c] : 0;
      sum[c] += p.coefficients[1 - half][c] * (p.halves[half][c].d * size + open);
    }
  }
  return sum;
}

Rgb ControlFilm::OpenCorrection(std::size_t pixel) const {
  const Pixel& p = pixels_[pixel];
  Rgb sum;
  for (int c = 0; c < 3; ++c) {
    sum[c] = p.coefficients[1 - p.groups % 2][c] * p.open[c];
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
      const double k = p.coefficients[1 - half][c];
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
  for (const Pixel& p : pixels_) {
    for (int half = 0; half < 2; ++half) {
      for (int c = 0; c < 3; ++c) {
        total.Add(p.halves[half][c]);
        coefficients += p.coefficients[half][c];
      }
    }
  }
  return {coefficients / (6 * static_cast<double>(pixels_.size())), total.Correlation()};
}

void ControlFilm::Save(StateWriter& state) const {
  state.Write("control variate pixels", pixels_.data(), pixels_.size());
}

void ControlFilm::Restore(StateReader& state) {
  state.Read("control variate pixels", pixels_.data(), pixels_.size());
}

}  // namespace lanelight
