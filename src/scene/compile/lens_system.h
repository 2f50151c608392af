// The lens system of a realistic camera, focused, with the bounds of its exit pupil.
#pragma once

#include "src/scene/compiled/camera.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Focused as a thick lens on what lies `focal_distance` camera units in front of the
/// film, and with the exit pupil bounded for a film of that diagonal. Lengths of a lens
/// file are millimetres, of which a camera unit has 1000; `unit`: scene lengths of a
/// camera unit. Throws InputError at the camera: lenses that let no light through, or
/// that cannot be focused at so short a distance; a picture of an aperture that cannot be
/// used.
LensSystem CompileLenses(const Camera& camera, double unit);

}  // namespace lanelight
