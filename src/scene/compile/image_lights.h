// Point lights with an image of their directions.
#pragma once

#include "src/scene/compile/light_list.h"
#include "src/scene/compile/light_texels.h"
#include "src/scene/compile/world_frame.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Adds a goniometric light, unless its image is black. Throws InputError at the light:
/// an image that cannot be used or is not square, a transform that is not rotation,
/// translation, mirroring and uniform scale.
void AddGoniometric(const Light& light, const WorldFrame& frame, LightImageTable& images,
                    LightList& lights);

/// The same for a projection light, whose image may have any aspect.
void AddProjection(const Light& light, const WorldFrame& frame, LightImageTable& images,
                   LightList& lights);

}  // namespace lanelight
