#include "src/image/control_film.h"

#include <algorithm>
#include <cmath>

#include "src/core/huge_pages.h"
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

ControlFilm::ControlFilm(int width, int height, const SampleGroups& groups)
    : width_(width), height_(height), groups_(groups) {
  const std::size_t pixels =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (groups.replicates) {
    ResizeInHugePages(replicates_, pixels);
  } else {
    ResizeInHugePages(halves_, pixels);
    open_.resize(pixels);
  }
  coefficients_.resize(pixels);
}

std::size_t ControlFilm::BytesPerPixel(const SampleGroups& groups) {
  return sizeof(Coefficients) +
         (groups.replicates ? sizeof(ReplicateSums) : sizeof(Halves) + sizeof(Open));
}

void ControlFilm::Add(std::size_t pixel, const ControlledSamples& samples) {
  for (std::uint32_t i = 0; i < samples.count; ++i) {
    const std::uint64_t sample = samples.first + i;
    for (int c = 0; c < 3; ++c) {
      const double d = double(samples.planes[c][i]);
      if (groups_.replicates) {
        replicates_[pixel].of[groups_.Replicate(sample)][c] += d;
        continue;
      }
      double &open_f = open_[pixel].f[c], &open_d = open_[pixel].d[c];
      open_f += double(samples.colors[c][i]);
      open_d += d;
      if ((sample + 1) % groups_.unit != 0) continue;
      halves_[pixel].of[sample / groups_.unit % 2][c].Add(open_f / groups_.unit,
                                                          open_d / groups_.unit);
      open_f = open_d = 0;
    }
  }
}

// Replicates alternate between the halves as units do.
ControlSums ControlFilm::Sums(const ControlledColors& colors, std::size_t pixel, int half,
                              int channel) const {
  if (!groups_.replicates) return halves_[pixel].of[half][channel];
  ControlSums sums;
  for (auto r = static_cast<std::uint32_t>(half); r < kReplicates; r += 2) {
    const auto n = static_cast<double>(groups_.InReplicate(colors.samples[pixel], r));
    if (n == 0) continue;
    sums.Add(colors.replicates[pixel].of[r][channel] / n,
             replicates_[pixel].of[r][channel] / n);
  }
  return sums;
}

void ControlFilm::FitRow(const ControlledColors& colors, int y) {
  const int y0 = std::max(0, y - kReach), y1 = std::min(height_, y + kReach + 1);
  std::vector<ControlScatter> columns(static_cast<std::size_t>(width_));
  for (int half = 0; half < 2; ++half) {
    for (int c = 0; c < 3; ++c) {
      for (int x = 0; x < width_; ++x) {
        ControlScatter& column = columns[static_cast<std::size_t>(x)];
        column = {};
        for (int ny = y0; ny < y1; ++ny) {
          column.Add(Sums(colors, Index(x, ny), half, c));
        }
      }
      for (int x = 0; x < width_; ++x) {
        ControlScatter own, window;
        own.Add(Sums(colors, Index(x, y), half, c));
        const int x1 = std::min(width_, x + kReach + 1);
        for (int nx = std::max(0, x - kReach); nx < x1; ++nx) {
          window.Add(columns[static_cast<std::size_t>(nx)]);
        }
        coefficients_[Index(x, y)].of[half][c] =
            static_cast<float>(FitCoefficient(own, window));
      }
    }
  }
}

void ControlFilm::Fit(const ControlledColors& colors) {
  ParallelFor(static_cast<std::size_t>(height_),
              [&](std::size_t y) { FitRow(colors, static_cast<int>(y)); });
}

Rgb ControlFilm::Correction(std::size_t pixel, std::uint64_t samples) const {
  Rgb sum;
  if (groups_.replicates) {
    ReplicateSums none;
    CorrectReplicates(pixel, none);
    for (int c = 0; c < 3; ++c) sum[c] = -none.Total(c);
    return sum;
  }
  // An incomplete unit belongs to the half that it would be in.
  const std::uint64_t open_half = samples / groups_.unit % 2;
  for (int c = 0; c < 3; ++c) {
    for (std::uint64_t half = 0; half < 2; ++half) {
      const double open = half == open_half ? open_[pixel].d[c] : 0;
      sum[c] += double(coefficients_[pixel].of[1 - half][c]) *
                (halves_[pixel].of[half][c].d * groups_.unit + open);
    }
  }
  return sum;
}

void ControlFilm::CorrectReplicates(std::size_t pixel, ReplicateSums& sums) const {
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    for (int c = 0; c < 3; ++c) {
      sums.of[r][c] -=
          double(coefficients_[pixel].of[1 - r % 2][c]) * replicates_[pixel].of[r][c];
    }
  }
}

Rgb ControlFilm::ResidualSquares(std::size_t pixel, std::uint64_t) const {
  Rgb out;
  for (int c = 0; c < 3; ++c) {
    double sum = 0, squares = 0, n = 0;
    for (int half = 0; half < 2; ++half) {
      const ControlSums& s = halves_[pixel].of[half][c];
      const double k = double(coefficients_[pixel].of[1 - half][c]);
      sum += s.f - k * s.d;
      squares += s.ff - 2 * k * s.fd + k * k * s.dd;
      n += s.n;
    }
    out[c] = n > 0 ? std::max(0.0, squares - sum * sum / n) : 0;
  }
  return out;
}

ControlReport ControlFilm::Report(const ControlledColors& colors) const {
  ControlScatter total;
  double coefficients = 0;
  for (std::size_t pixel = 0; pixel < coefficients_.size(); ++pixel) {
    for (int half = 0; half < 2; ++half) {
      for (int c = 0; c < 3; ++c) {
        total.Add(Sums(colors, pixel, half, c));
        coefficients += double(coefficients_[pixel].of[half][c]);
      }
    }
  }
  return {coefficients / (6 * static_cast<double>(coefficients_.size())),
          total.Correlation()};
}

std::vector<MutableStateColumn> ControlFilm::Columns() {
  if (groups_.replicates) {
    return {MakeStateColumn<double>("control_replicates",
                                    "sums of h - E[h], by replicate and channel",
                                    replicates_, {kReplicates, 3})};
  }
  return {MakeStateColumn<double>(
              "control_halves",
              "sums over units of 1, f, D, f f, f D, D D with D = h - E[h], "
              "by half and channel",
              halves_, {2, 3, 6}),
          MakeStateColumn<double>(
              "control_open", "sums of f and D over the incomplete unit", open_, {2, 3})};
}

}  // namespace lanelight
