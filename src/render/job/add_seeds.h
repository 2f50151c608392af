// Sums of renders of the same scene with different seeds.
#pragma once

#include "src/render/job/merge.h"

namespace lanelight {

/// Adds a render of a further seed, larger than those that are in `sum`. Throws
/// InputError unless both are whole, all their pixels have as many samples as any other
/// of the same render, and these are whole turns of the replicates.
void AddSeed(MergedRender& sum, MergedRender& more);

}  // namespace lanelight
