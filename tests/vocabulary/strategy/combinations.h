// Combinations of the choices of all axes that cover every pair of choices, as scenes can
// render them.
#pragma once

#include <string>
#include <vector>

#include "src/scene/prepare/prepared_scene.h"
#include "tests/vocabulary/strategy/covering.h"

namespace lanelight::test {

/// Every axis of src/vocabulary/strategy/choices.h with its choices; some choices appear
/// with several arguments.
const std::vector<Axis>& Axes();

/// A covering array of the axes, of 60 combinations or more.
const std::vector<Combination>& Combinations();

/// Returns the index of an axis. Requires that there is one of this name.
std::size_t AxisOf(const std::string& key);

/// Returns whether the scene can be rendered with the strategy on top of its own.
bool Accepts(const PreparedScene& scene, const std::string& strategy);

/// Returns the combination with the choices that the scene refuses set back to the first
/// of their axis. Of reuse=block or light-paths and what they refuse beside them,
/// `keep_reuse` says which stays.
Combination FitTo(const PreparedScene& scene, const Combination& combination,
                  bool keep_reuse);

}  // namespace lanelight::test
