#include "src/measure/compare/tile_test.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/stat/distributions.h"
#include "src/base/stat/values.h"

namespace lanelight {
namespace {

constexpr int kMaxTiles = 1024;  // about
constexpr int kMinSide = 8;

// Required number of samples of a tile.
constexpr double kMinObservations = 25;

}  // namespace

TileLayout LayoutOf(int width, int height) {
  const double pixels = double(width) * height;
  const int side = std::max(kMinSide, int(std::ceil(std::sqrt(pixels / kMaxTiles))));
  return {side, (width + side - 1) / side, (height + side - 1) / side};
}

double DependenceFactor(double squares) {
  constexpr double kOthers = 16 * 16 - 1;
  return 1 + std::sqrt(kOthers * std::max(0.0, squares - 1));
}

stat::MeanEstimate VarianceAround(const TileLayout& layout,
                                  const std::vector<stat::MeanEstimate>& tiles,
                                  std::size_t tile) {
  constexpr int kReach = 2;
  const int row = int(tile) / layout.columns;
  const int column = int(tile) % layout.columns;
  double sum = 0, quartic = 0;
  int count = 0;
  for (int y = row - kReach; y <= row + kReach; ++y) {
    for (int x = column - kReach; x <= column + kReach; ++x) {
      if (x < 0 || y < 0 || x >= layout.columns || y >= layout.rows) continue;
      const stat::MeanEstimate& one = tiles[std::size_t(y) * layout.columns + x];
      sum += one.variance;
      if (one.variance > 0) quartic += one.variance * one.variance / one.dof;
      ++count;
    }
  }
  return {0, sum / count, quartic > 0 ? sum * sum / quartic : 1e9};
}

bool HasEnoughObservations(const stat::MeanEstimate& own, const stat::MeanEstimate& other,
                           double other_per_own) {
  const double signal = std::max(std::abs(own.mean), std::abs(other.mean));
  const double variance =
      std::max(own.variance, other.variance * std::max(1.0, other_per_own));
  return signal * signal >= kMinObservations * variance;
}

double SignedZ(double p, const stat::MeanEstimate& a, const stat::MeanEstimate& b) {
  const double tail = std::clamp(p / 2, 1e-19, 0.5);
  const double z = tail < 0.5 ? -stat::NormalQuantile(tail) : 0;
  return a.mean < b.mean ? -z : z;
}

nlohmann::json TilesJson(const TileLayout& layout, const std::vector<double>& z) {
  nlohmann::json rows = nlohmann::json::array();
  for (int row = 0; row < layout.rows; ++row) {
    rows.push_back(nlohmann::json::array());
    for (int column = 0; column < layout.columns; ++column) {
      rows.back().push_back(NumberJson(z[std::size_t(row) * layout.columns + column]));
    }
  }
  return {{"side", layout.side},
          {"columns", layout.columns},
          {"rows", layout.rows},
          {"z", rows}};
}

}  // namespace lanelight
