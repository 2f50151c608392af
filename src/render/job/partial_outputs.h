// Names of the outputs of a render that ended early or has pixels without samples:
// NAME.partial.exr. They never replace an image with more samples.
#pragma once

#include <string>

#include "src/base/image/exr.h"
#include "src/render/job/render.h"

namespace lanelight {

/// Returns out.partial.exr for out.exr, or out.partial-2.exr if `number` is 2. Returns
/// empty paths and "-" (standard output) as they are.
std::string PartialPath(const std::string& path, int number = 1);

/// Returns the targets with the PartialPath of each file; `number` 0: as they are.
RenderTargets PartialTargets(RenderTargets targets, int number);

/// Returns the first number from `first` on whose PartialTargets may be written: no file
/// is there, or the image there is an earlier one of the same render. `image`: attributes
/// of the new image (OutputOptions).
int FreePartialNumber(const RenderTargets& targets, const ExrOptions& image, int first);

}  // namespace lanelight
