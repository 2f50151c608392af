// Which pixels of a film are rendered.
#pragma once

#include "src/base/image/pixel_rect.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// The film's crop window; the whole image if it has none.
inline PixelRect RenderedPixels(const Film& film) {
  const int* c = film.crop;
  if (c[0] == 0 && c[1] == 0 && c[2] == 0 && c[3] == 0) {
    return {0, 0, film.width, film.height};
  }
  return {c[0], c[2], c[1], c[3]};
}

}  // namespace lanelight
