// A small scene for the tests of the page that renders.
#pragma once

#include <string>

#include "src/measure/live/view.h"

namespace lanelight::live {

/// The Cornell box in 32 x 24 pixels.
inline LiveScene SmallLiveScene(int width = 32, int height = 24) {
  RenderSettings settings;
  settings.resolution = {width, height};
  return LiveScene(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt",
                   settings);
}

}  // namespace lanelight::live
