// Rows and columns of pixels.
#ifndef LANELIGHT_SIMD_PIXEL_INL_H_
#define LANELIGHT_SIMD_PIXEL_INL_H_

#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Column and row of pixel index row * width + column.
struct PixelPlace {
  VI row, column;

  // Float division is off by at most one row for images of less than 2^31 pixels, which
  // the correction undoes.
  HWY_INLINE PixelPlace(VI pixel, uint32_t image_width) {
    const DI di;
    const VI width = hn::Set(di, static_cast<int32_t>(image_width));
    row = hn::ConvertTo(di, hn::Mul(hn::ConvertTo(DF(), pixel),
                                    Splat(1.0f / static_cast<float>(image_width))));
    column = hn::Sub(pixel, hn::Mul(row, width));
    for (int step = 0; step < 2; ++step) {
      const auto low = hn::Lt(column, hn::Zero(di));
      row = hn::IfThenElse(low, hn::Sub(row, hn::Set(di, 1)), row);
      column = hn::IfThenElse(low, hn::Add(column, width), column);
      const auto high = hn::Gt(column, hn::Sub(width, hn::Set(di, 1)));
      row = hn::IfThenElse(high, hn::Add(row, hn::Set(di, 1)), row);
      column = hn::IfThenElse(high, hn::Sub(column, width), column);
    }
  }
};

LANELIGHT_END_KERNELS

#endif
