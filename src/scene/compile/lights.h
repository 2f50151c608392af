// Lights: one record per emitting primitive and per light of the file, the table to pick
// one, and the light index of every emitting primitive.
#pragma once

#include "src/scene/compile/compile.h"
#include "src/scene/compile/geometry.h"
#include "src/scene/compile/placement.h"
#include "src/scene/compile/spectrum_rows.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Sets the `light` of emitting records in `geometry` too. Lights without power get no
/// record. Probabilities are left to MakeLightChances. Throws
/// InputError at the directive for images and transforms that cannot be used; what is not
/// used of an image goes to `notes`. `spectra`: of paths that carry wavelengths; else
/// null.
LightTable CompileLights(const SceneDescription& description, const Placement& placement,
                         CompiledGeometry& geometry, std::vector<Note>& notes,
                         SpectrumRows* spectra = nullptr);

}  // namespace lanelight
