#include "src/scene/prepare/estimate_path_values.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/stat/relative_error.h"
#include "src/scene/prepare/cell_grid.h"

namespace lanelight {
namespace {

// Weight, in records, of the coarser cell in the estimate of a finer one.
constexpr double kCoarseCellWeight = 8;
// Least value of a cell relative to the mean of all cells: a short training pass may have
// missed its light.
constexpr double kMinCellValue = 0.1;

struct CellMean {
  double value = 0;
  bool known = false;
};

CellMean Blend(const CellSums& s, const CellMean& prior) {
  if (s.count == 0) return prior;
  const double borrowed = prior.known ? kCoarseCellWeight : 0;
  return {(s.value + borrowed * prior.value) / (s.count + borrowed), true};
}

}  // namespace

CellRecords::Sums CellRecords::Sorted() const {
  Sums sorted = sums_;
  std::ranges::sort(sorted,
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  return sorted;
}

void SetCellValues(const CellRecords& records, PathValues& values) {
  const CellGrid& fine = values.grid;
  LL_CHECK_EQ(records.cells(), fine.cells());
  const CellGrid coarse = CoarserGrid(fine);
  const CellRecords::Sums sums = records.Sorted();
  std::vector<CellSums> coarse_sums(coarse.cells());
  CellSums all;
  auto next = sums.begin();
  ForCells(fine, coarse, [&](std::uint32_t cell, std::uint32_t around) {
    if (next == sums.end() || next->first != cell) return;
    coarse_sums[around].Add(next->second);
    all.Add(next->second);
    ++next;
  });
  const double minimum = kMinCellValue * Blend(all, {}).value;
  values.survive.assign(fine.cells(), -1.0f);
  next = sums.begin();
  ForCells(fine, coarse, [&](std::uint32_t cell, std::uint32_t around) {
    CellMean m = Blend(coarse_sums[around], {});
    if (next != sums.end() && next->first == cell) m = Blend((next++)->second, m);
    if (m.known) values.survive[cell] = static_cast<float>(std::max(m.value, minimum));
  });
}

PilotImage::PilotImage(std::uint32_t width, std::uint32_t height,
                       std::span<const std::uint32_t> pixels,
                       std::span<const Vec3f> samples)
    : width_(width),
      height_(height),
      columns_((width + kTile - 1) / kTile),
      rows_((height + kTile - 1) / kTile) {
  const std::size_t per_pixel = samples.size() / pixels.size();
  LL_CHECK_EQ(per_pixel * pixels.size(), samples.size());
  for (const Vec3f& v : samples) {
    for (int c = 0; c < 3; ++c) {
      mean_[c] += std::max(v[c], 0.0f) / static_cast<double>(samples.size());
    }
  }
  std::vector<Sum> sums(std::size_t{columns_} * rows_);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::uint32_t pixel = pixels[i / per_pixel];
    Sum& sum =
        sums[std::size_t{pixel / width_ / kTile} * columns_ + pixel % width_ / kTile];
    for (int c = 0; c < 3; ++c) {
      sum.color[c] += std::clamp<double>(samples[i][c], 0, kClamp * mean_[c]);
    }
    sum.count += 1;
  }
  epsilon_ = std::min(kRelativeEpsilon, Mean() * Mean() / 4);
  Blur(sums);
}

void PilotImage::Sum::Add(const Sum& other, double weight) {
  for (int c = 0; c < 3; ++c) color[c] += weight * other.color[c];
  count += weight * other.count;
}

void PilotImage::Blur(const std::vector<Sum>& sums) {
  const int columns = static_cast<int>(columns_), rows = static_cast<int>(rows_);
  tiles_.resize(sums.size());
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      Sum sum;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns - 1); ++u) {
          sum.Add(sums[static_cast<std::size_t>(v * columns + u)],
                  (2 - std::abs(u - x)) * (2 - std::abs(v - y)));
        }
      }
      Sum& tile = tiles_[static_cast<std::size_t>(y * columns + x)];
      for (int c = 0; c < 3; ++c) {
        tile.color[c] = sum.count > 0 ? sum.color[c] / sum.count : mean_[c];
      }
    }
  }
}

float PilotImage::Channel(int c) const {
  // A channel that is black, or nearly, weighs what one of a hundredth of the mean would.
  return static_cast<float>(black() ? 1.0 / 3
                                    : Mean() / 3 / std::max(mean_[c], 0.01 * Mean()));
}

double PilotImage::ErrorWeight(std::uint32_t pixel, int c) const {
  const double color = Tile(pixel).color[c];
  return black() ? 0 : 1 / (color * color + epsilon_);
}

double PilotImage::Brightness(std::uint32_t pixel) const {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += double{Channel(c)} * Tile(pixel).color[c];
  return sum;
}

AlignedVector<float> PilotImage::Inverse() const {
  const double epsilon = Mean() * Mean() / 400;
  AlignedVector<float> inverse(std::size_t{width_} * height_ * 3);
  for (std::uint32_t i = 0; i < width_ * height_ && !black(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double color = Tile(i).color[c];
      const double weight = 1 / std::sqrt(3 * (color * color + epsilon));
      inverse[std::size_t{i} * 3 + static_cast<std::size_t>(c)] =
          static_cast<float>(weight / (3 * double{Channel(c)}));
    }
  }
  return inverse;
}

}  // namespace lanelight
