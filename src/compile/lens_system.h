// The lens system of a realistic camera, focused, with the bounds of its exit pupil.
#pragma once

#include <span>

#include "src/compiled/camera.h"
#include "src/core/vec.h"
#include "src/scene/description.h"

namespace lanelight {

/// Surface as LensSurface, in double precision.
struct LensElement {
  double z = 0, radius = 0, eta_ratio = 1, aperture = 0;
};

/// A ray in millimetres from the middle of the film; not normalised.
struct LensPath {
  Vec3d o, d;
};

/// Traces through all surfaces in their order, from lower to higher z. False where the
/// ray is stopped: beside an aperture or by total reflection. Any aperture is taken for a
/// circle.
bool TraceElements(std::span<const LensElement> elements, LensPath& ray);

/// Focused as a thick lens on what lies `focal_distance` camera units in front of the
/// film, and with the exit pupil bounded for a film of that diagonal. Lengths of a lens
/// file are millimetres, of which a camera unit has 1000; `unit`: scene lengths of a
/// camera unit. Throws InputError at the camera: lenses that let no light through, or
/// that cannot be focused at so short a distance; a picture of an aperture that cannot be
/// used.
LensSystem CompileLenses(const Camera& camera, double unit);

}  // namespace lanelight
