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

/// Focused as a thick lens on what lies `focal_distance` camera units in front of the
/// film, and with the exit pupil bounded for a film of that diagonal. Lengths of a lens
/// file are millimetres, of which a camera unit has 1000; `unit`: scene lengths of a
/// camera unit. Throws InputError at the camera: lenses that let no light through, or
/// that cannot be focused at so short a distance; a picture of an aperture that cannot be
/// used.
LensSystem CompileLenses(const Camera& camera, double unit);

/// Stores the camera's aperture unless it is a circle, scaled to the brightness of one.
/// Throws InputError at the camera for a file that is not a square image or is black.
void StoreAperture(const Camera& camera, LensSystem& lenses);

/// Distance from the axis beyond which the picture, looked up bilinearly, is black; in
/// units of the stop's radius. 1 without a picture.
double ApertureReach(const LensSystem& lenses);

/// `samples`: `pixelsamples` of the scene's Sampler, at least 1.
PixelFootprint CompileFootprint(const CompiledCamera& compiled, const Camera& camera,
                                const Film& film, int samples);

/// Nothing without a g-buffer. The camera's space is pbrt's: x to the right, y up, z
/// forward, in the units of its transform.
GbufferSpace CompileGbufferSpace(const Film& film, const Camera& camera,
                                 const WorldFrame& frame);

/// One axis of a filter at distance x from its centre, as pbrt-v4 defines it; 0 outside
/// the radius.
double EvaluateFilter(const Filter& filter, double radius, double x);

/// Throws InputError if the filter has no positive integral or a radius that is not
/// positive and finite.
CompiledFilter CompileFilter(const Filter& filter);

}  // namespace lanelight
