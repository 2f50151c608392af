#include "src/wavefront/allocation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/wavefront/tiles.h"

namespace lanelight {

namespace {

// Added to the squared mean in the relative error, as in src/estimate/estimate.h.
constexpr double kEpsilon = 0.01;
// Fewer cells of kSide make smaller ones.
constexpr std::size_t kFewCells = 64;
constexpr int kSide = 8, kSmallSide = 4;
static_assert(kShareBlock % kSide == 0 && kSide % kSmallSide == 0);

// Cells of the other colour around a cell, and how much they count. The farther ones are
// for cells at edges, and those whose neighbours have seen nothing.
struct Neighbour {
  int dx, dy;
  double weight;
};
constexpr double kFar = 0.1;
constexpr Neighbour kNeighbours[] = {{1, 0, 1},     {-1, 0, 1},     {0, 1, 1},
                                     {0, -1, 1},    {2, 1, kFar},   {2, -1, kFar},
                                     {-2, 1, kFar}, {-2, -1, kFar}, {1, 2, kFar},
                                     {1, -2, kFar}, {-1, 2, kFar},  {-1, -2, kFar}};

// The cells of a film, each with the sums of its own pixels.
class FilmCells {
 public:
  FilmCells(const FilmAccumulator& film, int side)
      : film_(film),
        side_(side),
        cx0_(film.x0() / side),
        cy0_(film.y0() / side),
        nx_((film.x0() + film.width() - 1) / side - cx0_ + 1),
        ny_((film.y0() + film.height() - 1) / side - cy0_ + 1),
        cells_(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_)) {
    for (int cy = 0; cy < ny_; ++cy) {
      for (int cx = 0; cx < nx_; ++cx) Measure(cx, cy);
    }
    for (int cy = 0; cy < ny_; ++cy) {
      for (int cx = 0; cx < nx_; ++cx) At(cx, cy).need = Need(cx, cy);
    }
    for (int colour : {0, 1}) Scale(colour);
  }

  double WeightAt(int x, int y) const {
    return At(x / side_ - cx0_, y / side_ - cy0_).weight;
  }

 private:
  struct Cell {
    double error = 0;  // sum over its pixels
    double pixels = 0;
    double need = 0;  // samples that it should have, up to a factor
    double weight = 1;
  };

  const Cell& At(int cx, int cy) const {
    return cells_[static_cast<std::size_t>(cy) * static_cast<std::size_t>(nx_) +
                  static_cast<std::size_t>(cx)];
  }
  Cell& At(int cx, int cy) { return const_cast<Cell&>(std::as_const(*this).At(cx, cy)); }

  PixelRect RectOf(int cx, int cy) const {
    const int x = (cx0_ + cx) * side_, y = (cy0_ + cy) * side_;
    return {std::max(x, film_.x0()), std::max(y, film_.y0()),
            std::min(x + side_, film_.x0() + film_.width()),
            std::min(y + side_, film_.y0() + film_.height())};
  }

  void Measure(int cx, int cy) {
    const PixelRect r = RectOf(cx, cy);
    Cell& cell = At(cx, cy);
    for (int y = r.y0; y < r.y1; ++y) {
      for (int x = r.x0; x < r.x1; ++x) {
        cell.error += RelativeVariance(r, x, y);
        ++cell.pixels;
      }
    }
  }

  // Relative to the mean around the pixel, but within its cell.
  double RelativeVariance(const PixelRect& cell, int x, int y) const {
    const Rgb variance = film_.PlainVariance(x, y);
    Rgb mean;
    double count = 0;
    for (int b = std::max(cell.y0, y - 1); b < std::min(cell.y1, y + 2); ++b) {
      for (int a = std::max(cell.x0, x - 1); a < std::min(cell.x1, x + 2); ++a) {
        mean += film_.PlainMean(a, b);
        ++count;
      }
    }
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double m = mean[c] / count;
      sum += variance[c] / (m * m + kEpsilon);
    }
    return sum / 3;
  }

  double Need(int cx, int cy) const {
    double error = 0, pixels = 0;
    for (const Neighbour& n : kNeighbours) {
      const int x = cx + n.dx, y = cy + n.dy;
      if (x < 0 || x >= nx_ || y < 0 || y >= ny_) continue;
      error += n.weight * At(x, y).error;
      pixels += n.weight * At(x, y).pixels;
    }
    return pixels > 0 ? std::sqrt(error / pixels) : 0;
  }

  // Sum over the pixels of a colour of weights at this scale, less the pixels.
  double Excess(int colour, double scale) const {
    double sum = 0;
    for (int cy = 0; cy < ny_; ++cy) {
      for (int cx = 0; cx < nx_; ++cx) {
        if (((cx0_ + cx + cy0_ + cy) & 1) != colour) continue;
        const Cell& cell = At(cx, cy);
        sum += cell.pixels * (Limited(scale * cell.need) - 1);
      }
    }
    return sum;
  }

  static double Limited(double weight) {
    return std::clamp(weight, kLeastShare, kMostShare);
  }

  // The factor at which weights have mean 1, by bisection in its logarithm.
  void Scale(int colour) {
    double least = INFINITY, most = 0;
    ForColour(colour, [&](Cell& cell) {
      if (cell.need > 0) least = std::min(least, cell.need);
      most = std::max(most, cell.need);
    });
    if (!(most > 0) || !std::isfinite(most)) return;
    double low = std::log(kLeastShare / most), high = std::log(kMostShare / least);
    for (int step = 0; step < 100; ++step) {
      const double middle = (low + high) / 2;
      (Excess(colour, std::exp(middle)) < 0 ? low : high) = middle;
    }
    const double scale = std::exp(high);
    ForColour(colour, [&](Cell& cell) { cell.weight = Limited(scale * cell.need); });
  }

  template <class Do>
  void ForColour(int colour, Do&& body) {
    for (int cy = 0; cy < ny_; ++cy) {
      for (int cx = 0; cx < nx_; ++cx) {
        if (((cx0_ + cx + cy0_ + cy) & 1) == colour) body(At(cx, cy));
      }
    }
  }

  const FilmAccumulator& film_;
  int side_, cx0_, cy0_, nx_, ny_;
  std::vector<Cell> cells_;
};

}  // namespace

int CellSide(const PixelRect& window) {
  return TilesOf(window, kSide).size() < kFewCells ? kSmallSide : kSide;
}

std::vector<PixelRect> CellsOf(const PixelRect& window) {
  return TilesOf(window, CellSide(window));
}

std::vector<double> WeighPixels(const FilmAccumulator& film, int side) {
  const FilmCells grid(film, side);
  std::vector<double> weights;
  weights.reserve(static_cast<std::size_t>(film.width()) *
                  static_cast<std::size_t>(film.height()));
  for (int y = film.y0(); y < film.y0() + film.height(); ++y) {
    for (int x = film.x0(); x < film.x0() + film.width(); ++x) {
      weights.push_back(grid.WeightAt(x, y));
    }
  }
  return weights;
}

}  // namespace lanelight
