// The integrator of a scene file.
#pragma once

#include <optional>
#include <string>

#include "src/base/core/source_location.h"
#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight {

struct Integrator {
  int max_depth = 5;     // scattering events at most, as in pbrt
  std::string strategy;  // changes to the strategy (src/vocabulary/strategy/strategy.h)
  SourceLocation strategy_where;
  /// Surfaces scatter evenly, with the reflectance that their material has for light from
  /// where they are seen (pbrt-v4's option "forcediffuse").
  bool force_diffuse = false;
  /// Microfacets are rougher behind a bounce that is not specular: below 0.3, alpha
  /// becomes 2 alpha, but at least 0.1 and at most 0.3 (pbrt-v4's "regularize").
  bool regularize = false;
  /// Nothing: the file does not say it. CompileScene then takes RGB.
  std::optional<Transport> transport;
};

}  // namespace lanelight
