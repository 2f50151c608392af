#include "src/render/parts.h"

#include <algorithm>
#include <cstdint>

#include "src/core/check.h"
#include "src/core/error.h"
#include "src/wavefront/tiles.h"

namespace lanelight {
namespace {

constexpr int kSide = 16;
// Tiles of a part: with as many, parts of uneven scenes differ by a few percent.
constexpr std::size_t kTilesPerPart = 64;

std::uint64_t Spread(std::uint32_t v) {
  std::uint64_t bits = 0;
  for (int i = 0; i < 32; ++i) bits |= std::uint64_t{v >> i & 1} << (2 * i);
  return bits;
}

std::uint64_t AlongZ(const PixelRect& tile, int side) {
  return Spread(static_cast<std::uint32_t>(tile.x0 / side)) |
         Spread(static_cast<std::uint32_t>(tile.y0 / side)) << 1;
}

}  // namespace

std::vector<PixelRect> TilesOfPart(const PixelRect& window, const Part& part,
                                   int least_side) {
  LL_CHECK(part.index >= 1 && part.index <= part.count);
  const auto count = static_cast<std::size_t>(part.count);
  int side = kSide;
  std::vector<PixelRect> all = TilesOf(window, side);
  while (count > 1 && side > least_side && all.size() < kTilesPerPart * count) {
    side /= 2;
    all = TilesOf(window, side);
  }
  if (all.size() < count) {
    throw InputError(fmt::format(
        "{} parts are more than the {} tiles of {}x{} pixels that this render can be cut "
        "into: at most {} parts, or renders with different seeds",
        part.count, all.size(), side, side, all.size()));
  }
  std::sort(all.begin(), all.end(), [side](const PixelRect& a, const PixelRect& b) {
    return AlongZ(a, side) < AlongZ(b, side);
  });
  std::vector<PixelRect> own;
  for (auto i = static_cast<std::size_t>(part.index - 1); i < all.size(); i += count) {
    own.push_back(all[i]);
  }
  return own;
}

}  // namespace lanelight
