// What paths cost in dense media, before any is rendered.
#pragma once

#include <vector>

#include "src/scene/compile/placement.h"
#include "src/scene/compiled/media.h"

namespace lanelight {

/// Collisions, real and null ones, beyond which a medium is noted.
inline constexpr double kManyCollisions = 3000;

/// Mean number of collisions of a path of each channel in a body of volume V and surface
/// S, the largest of all channels. A path that enters anywhere goes 4 V / S on average,
/// however it scatters, unless `max_depth` or absorption ends it. Media that vary have
/// null collisions besides.
double MeanCollisions(const MediumRecord& medium, const MediumGrid* grid,
                      double mean_chord, int max_depth);

/// A note for each medium, `at` its record or kVacuum, with more than kManyCollisions.
void NoteDenseMedia(const SceneDescription& description, const Placement& placement,
                    const MediumTable& table, const std::vector<std::int32_t>& at,
                    std::vector<Note>& notes);

}  // namespace lanelight
