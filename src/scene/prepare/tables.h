// Tables that some strategies need, estimated by training passes and read by kernels.
// They steer probabilities and numbers of split paths, and never enter the image.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/scene/compiled/lights.h"

namespace lanelight {

/// Cells of a box, times the six dominant directions of the normal.
struct CellGrid {
  float low[3] = {}, per_unit[3] = {};  // cell = (p - low) * per_unit
  std::int32_t size[3] = {1, 1, 1};

  std::uint32_t cells() const {
    return static_cast<std::uint32_t>(size[0] * size[1] * size[2]) * 6;
  }
};

/// Values of paths, for roulette=adjoint: a coarse cache over space and orientation,
/// and the brightness of pixels. Cells without records have a negative `survive`.
struct PathValues {
  CellGrid grid;
  /// Brightness is sum_c channel[c] c: all channels count alike in the mean of the image,
  /// as they do in a relative error.
  float channel[3] = {1.0f / 3, 1.0f / 3, 1.0f / 3};
  AlignedVector<float> inverse_pixel;  // PilotImage::Inverse
  AlignedVector<float> survive;        // the mean estimate of the cell
};

/// Where light subpaths from infinity start, learned from what they bring to the image.
/// Each distant light has a square of cells across its direction, as wide as the scene.
/// The infinite lights together have one for each of kSkyBins^2 directions of the
/// octahedral map.
struct EmissionGuide {
  static constexpr std::uint32_t kSunSide = 64, kSkySide = 16, kSkyBins = 8;
  /// Probability of starting on the whole disk, whatever has been learned.
  static constexpr float kDefensive = 0.1f;

  // These follow from the scene.
  AlignedVector<std::int32_t> distant;  // per light: its first cell; -1: none
  std::int32_t sky = -1;                // first cell of all infinite lights; -1: none
  std::uint32_t num_cells = 0;
  // The tables are made of the weights once these have been learned.
  std::vector<double> cell_weights, light_weights;
  LightStarts lights;
  // Per cell; an alias table of each square, with places in it.
  AlignedVector<float> pmf, alias_q;
  AlignedVector<std::uint32_t> alias;

  bool has_learned() const { return !pmf.empty(); }
};

/// Probabilities of selecting lights, learned from what they bring to cells of the scene:
/// of groups of lights by cell, and of a light within its group by power.
struct LearnedLights {
  // These follow from the scene.
  std::uint32_t num_groups = 0;
  bool is_grouped = false;            // else group i is light i
  AlignedVector<std::int32_t> group;  // by light
  AlignedVector<float> within;        // by light: probability within its group; or 0
  // The lights of one group after the other, and a Walker-Vose table of each group.
  AlignedVector<std::int32_t> first, count;  // by group
  AlignedVector<float> member_q;
  AlignedVector<std::int32_t> member, member_alias;  // lights

  CellGrid grid;
  AlignedVector<std::int32_t> row;  // by cell: the row of its probabilities
  // These have an entry for each row and group. The tables are made of the weights.
  std::vector<double> weights;
  AlignedVector<float> pmf, alias_q;
  AlignedVector<std::uint32_t> alias;

  bool has_learned() const { return !row.empty(); }
};

struct StrategyTables {
  LearnedLights lights;    // light-selection=learned: by a training pass
  PathValues path_values;  // roulette=adjoint: by training passes
  EmissionGuide emission;  // light-paths=splats: by a training pass
};

}  // namespace lanelight
