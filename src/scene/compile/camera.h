// Camera, lenses, pixel footprint, g-buffer space and pixel filter in scene coordinates.
#pragma once

#include "src/scene/compile/world_frame.h"
#include "src/scene/compiled/camera.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Throws InputError for a camera that maps space onto a plane, a field of view outside
/// (0, 180), an empty screen window.
CompiledCamera CompileCamera(const Camera& camera, const Film& film,
                             const WorldFrame& frame);

/// Returns the lenses, focused as a thick lens at `focal_distance` camera units in front
/// of the film, with bounds of the exit pupil. Lens files are in millimetres, 1000 per
/// camera unit; `unit` is a camera unit in scene lengths. Throws InputError at the camera
/// for lenses that transmit no light or cannot be focused, and for unusable aperture
/// images.
LensSystem CompileLenses(const Camera& camera, double unit);

/// Stores the camera's aperture unless it is a circle, scaled to the brightness of one.
/// Throws InputError at the camera for a file that is not a square image or is black.
void StoreAperture(const Camera& camera, LensSystem& lenses);

/// Returns the distance from the axis, in radii of the stop, beyond which the aperture's
/// image is black; 1 without an image.
double ApertureReach(const LensSystem& lenses);

/// Returns the footprint of a pixel. `samples` is `pixelsamples` of the scene's Sampler.
PixelFootprint CompileFootprint(const CompiledCamera& compiled, const Camera& camera,
                                const Film& film, int samples);

/// Returns the space of the g-buffer, if there is one. As in pbrt, camera space has x to
/// the right, y up, z forward, in the units of its transform.
GbufferSpace CompileGbufferSpace(const Film& film, const Camera& camera,
                                 const WorldFrame& frame);

/// Returns the value of one axis of a filter at distance x from its centre, as in
/// pbrt-v4.
double EvaluateFilter(const Filter& filter, double radius, double x);

/// Throws InputError if the filter has no positive integral or a radius that is not
/// positive and finite.
CompiledFilter CompileFilter(const Filter& filter);

}  // namespace lanelight
