// Infinite lights that are seen through a portal.
#pragma once

#include <vector>

#include "src/scene/compile/light_list.h"
#include "src/scene/compile/world_frame.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Adds an infinite light, of an image or constant, that enters through its portal,
/// unless what it shows there is black. Throws InputError at the light: a portal that is
/// no rectangle, an image that CompileEnvironment cannot use.
void AddPortalLight(const Light& light, const WorldFrame& frame, std::vector<Note>& notes,
                    LightList& lights);

/// The portal of a light with four corners, and what of `environment` is seen through it:
/// the map, bilinearly, at the middle of each texel, of which there are as many as the
/// map has.
Portal CompilePortal(const Light& light, const WorldFrame& frame,
                     const Environment& environment);

}  // namespace lanelight
