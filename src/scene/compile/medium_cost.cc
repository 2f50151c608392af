#include "src/scene/compile/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

// Of one core, for a collision in a homogeneous medium and in one that varies (measured
// on an AMD EPYC with AVX-512).
constexpr double kSecondsPerEvent = 4e-8, kSecondsPerNull = 2.5e-8;

// Returns the mean chord of a box: 4 times its volume over its surface.
double MeanChord(const Box& box) {
  if (box.empty()) return 0;
  const Vec3d d = box.max - box.min;
  const double surface = 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
  return surface > 0 ? 4 * d.x * d.y * d.z / surface : 0;
}

// Returns the longest mean chord of the bodies that the medium fills; around the camera
// or outside of shapes that is the whole scene.
double LongestChord(const SceneDescription& d, const Placement& placement, Index medium) {
  double longest = d.camera.medium == medium ? MeanChord(placement.bounds) : 0;
  ForEachPlaced(placement, [&](const PlacedShape& placed) {
    const MediumInterface& media = placed.shape->media;
    if (media.inside == medium) {
      longest = std::max(longest, MeanChord(ShapeBox(placed)));
    } else if (media.outside == medium) {
      longest = std::max(longest, MeanChord(placement.bounds));
    }
  });
  return longest;
}

double MeanMajorant(const MediumGrid& grid) {
  double sum = 0;
  for (const float v : grid.majorants) sum += v;
  return grid.majorants.empty() ? 0 : sum / static_cast<double>(grid.majorants.size());
}

}  // namespace

double MeanCollisions(const MediumRecord& medium, const MediumGrid* grid,
                      double mean_chord, int max_depth) {
  // Shadow rays through a grid have null collisions by the largest channel.
  const double largest =
      double{std::max({medium.sigma_t[0], medium.sigma_t[1], medium.sigma_t[2]})};
  if (grid != nullptr) {
    const double scale = grid->source == MediumSource::kColors ? 1 : largest;
    return scale * MeanMajorant(*grid) * mean_chord;
  }
  double maximum = 0;
  for (int c = 0; c < 3; ++c) {
    const double extinction = medium.sigma_t[c],
                 absorbed = extinction - medium.sigma_s[c];
    double events = extinction * mean_chord;
    if (absorbed > 0) events = std::min(events, extinction / absorbed);
    if (medium.inside == 0) events = std::min<double>(events, max_depth);
    maximum = std::max(maximum, medium.scatters != 0 ? events : 0);
  }
  return maximum;
}

void NoteDenseMedia(const SceneDescription& description, const Placement& placement,
                    const MediumTable& table, const std::vector<std::int32_t>& at,
                    std::vector<Note>& notes) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i] == kVacuum) continue;
    const Medium& medium = description.media[i];
    const MediumRecord& record = table.media[static_cast<std::size_t>(at[i])];
    const MediumGrid* grid =
        record.grid < 0 ? nullptr : &table.grids[static_cast<std::size_t>(record.grid)];
    const double chord = LongestChord(description, placement, static_cast<Index>(i)) *
                         placement.frame.scale;
    const double collisions =
        MeanCollisions(record, grid, chord, description.integrator.max_depth);
    if (!(collisions > kManyCollisions)) continue;
    const double seconds =
        collisions * (grid == nullptr ? kSecondsPerEvent : kSecondsPerNull);
    const char* who = grid == nullptr ? "path" : "path or shadow ray";
    const char* remedy = grid != nullptr || medium.in_material
                             ? "use a smaller \"scale\" or \"sigma_s\" to render faster"
                             : "--max-depth limits them";
    notes.push_back(
        {medium.where,
         fmt::format("medium {} is dense: a {} in it has about {:.1g} collisions, some "
                     "{:.1g} s of one core; {}",
                     Quoted(medium.name), who, collisions, seconds, remedy)});
  }
}

}  // namespace lanelight
