// A binary tree over the lights that have a place, for light-selection=tree.
#pragma once

#include <span>

#include "src/scene/compiled/scene.h"

namespace lanelight {

/// Tree over the lights of positive weight. Splits minimise the cost of Conty Estevez and
/// Kulla 2018: power times bounded area times a measure of the cone of normals.
LightTree BuildLightTree(const Geometry& geometry, std::span<const LightRecord> lights,
                         std::span<const double> weights);

}  // namespace lanelight
