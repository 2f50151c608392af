#include "src/base/image/repair.h"

#include <cmath>

namespace lanelight {

std::size_t ReplaceNotFinite(Image* image) {
  std::size_t count = 0;
  for (float& value : image->pixels) {
    if (std::isfinite(value)) continue;
    value = std::isnan(value) ? 0 : std::copysign(kLargestHalf, value);
    ++count;
  }
  return count;
}

}  // namespace lanelight
