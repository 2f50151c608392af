// Chooses what the paths of a render carry if the scene decides (--transport scene).
#pragma once

#include <span>
#include <string>

#include "src/base/core/source_location.h"
#include "src/vocabulary/path/scene_kinds.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct SceneDescription;  // src/scene/description/description.h

struct TransportChoice {
  Transport transport = Transport::kRgb;
  std::string why;  // "the metal \"spoon\" has a spectrum"
  /// Set where wavelengths would be carried, were they not refused.
  SourceLocation refused_at = {};
  bool refused = false;
};

/// Chooses wavelengths if a material or a light has a spectrum, or glass disperses, and
/// neither the scene nor one of the strategies refuses them; else red, green and blue.
TransportChoice ChooseTransport(const SceneDescription& scene,
                                std::span<const Strategy> strategies);

}  // namespace lanelight
