// Pixel filters as sampling tables.
#pragma once

#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// One axis of a filter at distance x from its centre, as pbrt-v4 defines it; 0 outside
/// the radius.
double EvaluateFilter(const Filter& filter, double radius, double x);

/// Throws InputError if the filter has no positive integral or a radius that is not
/// positive and finite.
CompiledFilter CompileFilter(const Filter& filter);

}  // namespace lanelight
