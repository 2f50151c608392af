// seen-lights=apart: where on the film lights lie that are too small for a few camera
// rays of each pixel to find.
#pragma once

#include <cstdint>
#include <vector>

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// Pixels (y * image width + x, ascending, each once) that may see an emitting shape
/// whose picture is smaller than kSmallLight pixels across its radius, out of focus or
/// not; whether it is hidden is not asked. Shapes at or behind the camera have no
/// picture.
std::vector<std::uint32_t> PlacesOfSmallLights(const PreparedScene& scene);
inline constexpr double kSmallLight = 2;

}  // namespace lanelight
