#include "src/measure/live/cost_map.h"

#include <algorithm>

namespace lanelight::live {
namespace {

int Cells(int pixels) { return (pixels + CostMap::kCell - 1) / CostMap::kCell; }

}  // namespace

CostMap::CostMap(int width, int height)
    : columns_(Cells(width)),
      cells_(static_cast<std::size_t>(columns_) *
             static_cast<std::size_t>(Cells(height))) {}

void CostMap::Add(const PixelRect& tile, const RunCounts& counts) {
  const double pixels = double(tile.pixels());
  for (int y = tile.y0 / kCell; y < Cells(tile.y1); ++y) {
    for (int x = tile.x0 / kCell; x < Cells(tile.x1); ++x) {
      const int w = std::min(tile.x1, (x + 1) * kCell) - std::max(tile.x0, x * kCell);
      const int h = std::min(tile.y1, (y + 1) * kCell) - std::max(tile.y0, y * kCell);
      const double share = double(w) * h / pixels;
      Cell& cell =
          cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(x)];
      cell.samples += share * double(counts.samples);
      cell.closest += share * double(counts.rays_closest);
      cell.shadow += share * double(counts.rays_shadow);
    }
  }
}

const CostMap::Cell& CostMap::At(int x, int y) const {
  return cells_[static_cast<std::size_t>(y / kCell) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(x / kCell)];
}

double CostMap::RaysPerSample(int x, int y) const {
  const Cell& cell = At(x, y);
  return cell.samples > 0 ? (cell.closest + cell.shadow) / cell.samples : 0;
}

double CostMap::SegmentsPerSample(int x, int y) const {
  const Cell& cell = At(x, y);
  return cell.samples > 0 ? cell.closest / cell.samples : 0;
}

}  // namespace lanelight::live
