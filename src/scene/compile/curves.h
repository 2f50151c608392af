// Curves to records.
#pragma once

#include <cstdint>

#include "src/scene/compile/placement.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// The box of the points of all curves of a shape, widened by half their width.
Box CurveBox(const Shape& shape, const Transform& transform);

/// Appends the curves of a shape. Throws InputError beyond kMostCurves, and where the
/// transform flattens them so far that float32 overflows.
void AddCurves(const PlacedShape& placed, const WorldFrame& frame, std::uint32_t material,
               Geometry& geometry);

/// In one scene, copies made of instances counted: what 32-bit offsets reach.
inline constexpr std::size_t kMostCurves = std::size_t{1} << 26;

}  // namespace lanelight
