// Rectangles of pixels.
#pragma once

#include <cstdint>

namespace lanelight {

/// The pixels [x0, x1) x [y0, y1) of an image, rows from the top.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(width()) * static_cast<std::uint64_t>(height());
  }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

}  // namespace lanelight
