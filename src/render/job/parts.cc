#include "src/render/job/parts.h"

#include <algorithm>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/render/wave/tiles.h"

namespace lanelight {
namespace {

constexpr int kSide = 16;

}  // namespace

std::vector<PixelRect> TilesOfPart(const PixelRect& window, const Part& part,
                                   int min_side) {
  LL_CHECK(part.index >= 1 && part.index <= part.count);
  const std::vector<int> equal(static_cast<std::size_t>(part.count), 1);
  auto parts = DistributeTiles(TilesOf(window, kSide), equal, min_side);
  // The last one has least.
  if (parts.back().empty()) {
    const auto tiles =
        std::ranges::count_if(parts, [](const auto& p) { return !p.empty(); });
    const int side = std::min(kSide, min_side);
    throw InputError(fmt::format(
        "{} parts are more than the {} tiles of {}x{} pixels that this render can be "
        "divided into: at most {} parts, or renders with different seeds",
        part.count, tiles, side, side, tiles));
  }
  return std::move(parts[std::size_t(part.index - 1)]);
}

}  // namespace lanelight
