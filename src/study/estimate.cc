#include "src/study/estimate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/core/check.h"

namespace lanelight {
namespace {

constexpr int kTile = 8;
constexpr int kFewTiles = 16;

// Largest tile side of at most kTile that gives kFewTiles tiles, or 1.
int ChooseTile(int width, int height) {
  const auto tiles = [&](int side) {
    return static_cast<std::int64_t>((width + side - 1) / side) *
           ((height + side - 1) / side);
  };
  int side = kTile;
  while (side > 1 && tiles(side) < kFewTiles) side /= 2;
  return side;
}

// Weighted mean over tiles and its t interval. The weights are the pixels per tile, which
// differ only at the border.
class TileMean {
 public:
  void Add(double sum, std::uint64_t pixels) {
    if (pixels == 0) return;
    sums_.push_back(sum);
    pixels_.push_back(static_cast<double>(pixels));
  }

  std::uint64_t tiles() const { return sums_.size(); }

  Interval Estimate() const {
    double total = 0, weight = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      total += sums_[i];
      weight += pixels_[i];
    }
    const double mean = total / weight;
    if (tiles() < 2) return {mean, mean, mean};
    // Variance of a ratio of sums (Cochran 1977, "Sampling Techniques", equation 2.39).
    double squares = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const double residual = sums_[i] - mean * pixels_[i];
      squares += residual * residual;
    }
    const double n = static_cast<double>(tiles());
    const double deviation = std::sqrt(squares * n / (n - 1)) / weight;
    const double half = StudentQuantile975(tiles() - 1) * deviation;
    return {mean, std::max(0.0, mean - half), mean + half};
  }

 private:
  std::vector<double> sums_, pixels_;
};

Interval SquareRoot(const Interval& v) {
  return {std::sqrt(v.value), std::sqrt(v.low), std::sqrt(v.high)};
}

struct TileSums {
  double variance = 0, relative = 0;
  std::uint64_t pixels = 0;

  void Add(const PixelEstimate& p) {
    for (int c = 0; c < 3; ++c) {
      variance += p.variance[c] / 3;
      relative += p.variance[c] / (p.mean[c] * p.mean[c] + kRelativeEpsilon) / 3;
    }
    ++pixels;
  }
};

}  // namespace

double StudentQuantile975(std::uint64_t degrees) {
  LL_CHECK_GE(degrees, std::uint64_t{1});
  static constexpr double kSmall[] = {12.7062, 4.30265, 3.18245, 2.77645};
  if (degrees <= 4) return kSmall[degrees - 1];
  // Cornish-Fisher expansion about the normal quantile (Abramowitz and Stegun 26.7.5).
  const double z = 1.959963985, v = static_cast<double>(degrees);
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, z9 = z7 * z * z;
  const double v2 = v * v;
  return z + (z3 + z) / (4 * v) + (5 * z5 + 16 * z3 + 3 * z) / (96 * v2) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * v2 * v) +
         (79 * z9 + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / (92160 * v2 * v2);
}

ErrorEstimate EstimateError(int width, int height,
                            const std::function<PixelEstimate(int, int)>& pixel) {
  ErrorEstimate out;
  out.tile = ChooseTile(width, height);
  TileMean variance, relative;
  for (int y0 = 0; y0 < height; y0 += out.tile) {
    for (int x0 = 0; x0 < width; x0 += out.tile) {
      TileSums tile;
      for (int y = y0; y < std::min(height, y0 + out.tile); ++y) {
        for (int x = x0; x < std::min(width, x0 + out.tile); ++x) {
          const PixelEstimate p = pixel(x, y);
          if (p.known) tile.Add(p);
        }
      }
      variance.Add(tile.variance, tile.pixels);
      relative.Add(tile.relative, tile.pixels);
      out.pixels += tile.pixels;
    }
  }
  out.tiles = variance.tiles();
  out.available = out.pixels > 0;
  out.has_interval = out.tiles >= 2;
  if (!out.available) return out;
  out.rmse = SquareRoot(variance.Estimate());
  out.relmse = relative.Estimate();
  return out;
}

ErrorEstimate EstimateError(const FilmAccumulator& film) {
  return EstimateError(film.width(), film.height(), [&film](int x, int y) {
    const int px = film.x0() + x, py = film.y0() + y;
    if (!film.HasVariance(px, py)) return PixelEstimate{};
    return PixelEstimate{true, film.Mean(px, py), film.Variance(px, py)};
  });
}

}  // namespace lanelight
