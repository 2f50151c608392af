#include "src/base/state/tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

bool Contains(const PixelRect& outer, const PixelRect& r) {
  return outer.x0 <= r.x0 && outer.y0 <= r.y0 && r.x1 <= outer.x1 && r.y1 <= outer.y1;
}

// The top or bottom edge of a tile.
struct Edge {
  int y;
  bool top;
  const PixelRect* tile;
};

// Edges from the top; where tiles touch, one ends before the other begins.
std::vector<Edge> SortedEdges(const std::vector<PixelRect>& tiles) {
  std::vector<Edge> edges;
  for (const PixelRect& tile : tiles) {
    edges.push_back({tile.y0, true, &tile});
    edges.push_back({tile.y1, false, &tile});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.y != b.y ? a.y < b.y : a.top < b.top;
  });
  return edges;
}

std::string Overlap(const std::vector<PixelRect>& tiles) {
  std::map<int, const PixelRect*> open;  // tiles of the current row, by x0
  for (const Edge& edge : SortedEdges(tiles)) {
    const PixelRect& tile = *edge.tile;
    if (!edge.top) {
      open.erase(tile.x0);
      continue;
    }
    // Only the last tile that begins left of this one's end can overlap it.
    const auto next = open.lower_bound(tile.x1);
    if (next != open.begin() && std::prev(next)->second->x1 > tile.x0) {
      return fmt::format("the tiles {} and {} overlap",
                         ToString(*std::prev(next)->second), ToString(tile));
    }
    open[tile.x0] = &tile;
  }
  return "";
}

}  // namespace

std::string ToString(const PixelRect& rect) {
  return fmt::format("[{}, {}) x [{}, {})", rect.x0, rect.x1, rect.y0, rect.y1);
}

std::string TileProblem(const std::vector<PixelRect>& tiles, const PixelRect& window) {
  for (const PixelRect& tile : tiles) {
    if (tile.x0 >= tile.x1 || tile.y0 >= tile.y1) {
      return fmt::format("the tile {} has no pixels", ToString(tile));
    }
    if (!Contains(window, tile)) {
      return fmt::format("the tile {} is not inside the film {}", ToString(tile),
                         ToString(window));
    }
  }
  return Overlap(tiles);
}

TileRows::TileRows(const std::vector<PixelRect>& tiles, const PixelRect& window)
    : tiles_(tiles), first_(1, 0), window_(window) {
  for (const PixelRect& tile : tiles) first_.push_back(first_.back() + tile.pixels());
}

TileRows::Run TileRows::At(std::size_t file, std::size_t count) const {
  LL_DCHECK(file < size());
  const auto after = std::upper_bound(first_.begin(), first_.end(), file);
  const std::size_t index = static_cast<std::size_t>(after - first_.begin()) - 1;
  const PixelRect& tile = tiles_[index];
  const std::size_t width = static_cast<std::size_t>(tile.width()),
                    film_width = static_cast<std::size_t>(window_.width()),
                    pixel = file - first_[index], x = pixel % width, y = pixel / width,
                    left = static_cast<std::size_t>(tile.x0 - window_.x0),
                    above = static_cast<std::size_t>(tile.y0 - window_.y0);
  // A tile as wide as the film is one run.
  const std::size_t rest = width == film_width ? *after - file : width - x;
  return {file, (above + y) * film_width + left + x, std::min(count, rest)};
}

}  // namespace lanelight
