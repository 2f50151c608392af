// Pictures of apertures, built-in and of files, as pbrt-v4 has them.
#pragma once

#include "src/scene/compiled/camera.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Stores the camera's aperture unless it is a circle, scaled to the brightness of one.
/// Throws InputError at the camera for a file that is not a square image or is black.
void StoreAperture(const Camera& camera, LensSystem& lenses);

/// Distance from the axis beyond which the picture, looked up bilinearly, is black; in
/// units of the stop's radius. 1 without a picture.
double ApertureReach(const LensSystem& lenses);

}  // namespace lanelight
