#include "src/measure/compare/error_tiles.h"

#include <algorithm>
#include <cmath>

#include "src/base/stat/relative_error.h"
#include "src/measure/compare/tile_test.h"

namespace lanelight {
namespace {

struct ErrorSum {
  double error = 0;
  std::size_t count = 0;
};

}  // namespace

std::vector<ErrorTile> WorstTiles(const LinearImage& test, const LinearImage& reference,
                                  std::size_t most) {
  const TileLayout layout = LayoutOf(test.width, test.height);
  std::vector<ErrorSum> sums(layout.size());
  double total = 0;
  for (std::size_t i = 0; i < test.pixels(); ++i) {
    const int x = static_cast<int>(i % test.width), y = static_cast<int>(i / test.width);
    for (int c = 0; c < 3; ++c) {
      const double b = reference.planes[c][i], d = test.planes[c][i] - b;
      const double error = d * d / (b * b + kRelativeEpsilon);
      if (!std::isfinite(error)) continue;
      sums[layout.At(x, y)].error += error;
      ++sums[layout.At(x, y)].count;
      total += error;
    }
  }
  std::vector<ErrorTile> out;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!(sums[i].error > 0)) continue;
    const int x = static_cast<int>(i) % layout.columns * layout.side;
    const int y = static_cast<int>(i) / layout.columns * layout.side;
    out.push_back({x, y, std::min(layout.side, test.width - x),
                   std::min(layout.side, test.height - y),
                   sums[i].error / double(sums[i].count), sums[i].error / total});
  }
  std::sort(out.begin(), out.end(),
            [](const ErrorTile& a, const ErrorTile& b) { return a.share > b.share; });
  out.resize(std::min(out.size(), most));
  return out;
}

}  // namespace lanelight
