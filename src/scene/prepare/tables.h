// Tables that some strategies need, estimated by training passes and read by kernels.
// They steer probabilities and numbers of split paths, and never enter the image.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/scene/compiled/lights.h"

namespace lanelight {

class PilotImage;      // src/scene/prepare/estimate_path_values.h
struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// Cells of a box, times the six dominant directions of the normal.
struct CellGrid {
  float low[3] = {}, per_unit[3] = {};  // cell = (p - low) * per_unit
  std::int32_t size[3] = {1, 1, 1};

  std::uint32_t cells() const {
    return static_cast<std::uint32_t>(size[0] * size[1] * size[2]) * 6;
  }
};

/// Values of paths, for roulettes that split: a coarse cache over space and orientation,
/// and the brightness of pixels. Cells without records have a negative `survive`.
struct PathValues {
  CellGrid grid;
  /// Brightness is sum_c channel[c] c: all channels count alike in the mean of the image,
  /// as they do in a relative error.
  float channel[3] = {1.0f / 3, 1.0f / 3, 1.0f / 3};
  AlignedVector<float> inverse_pixel;  // PilotImage::Inverse
  /// adjoint: the mean estimate. efficiency: sqrt(E[estimate^2] / cost).
  AlignedVector<float> survive;
  /// efficiency: sqrt(variance of the estimate / cost).
  AlignedVector<float> split;
  float scale = 1;  // efficiency: sqrt(cost / relative variance) of a camera path
};

/// For shadow-roulette=contribution. The root of the sum over the channels of the squares
/// of what a ray carries times `inverse`, at least `floor`, is the probability with which
/// it is traced.
struct ShadowThreshold {
  float floor = 0.1f;            // least probability, in (0, 1]
  AlignedVector<float> inverse;  // 3 per pixel of the full image; empty = all are traced
};

/// Tracing a ray that adds v to a pixel of colour I with probability s adds v^2 (1/s - 1)
/// to the variance of the sample. It saves (1 - s) of the ray's cost t. Variance times
/// cost is least with s = v / pixel_threshold, where
///   pixel_threshold = sqrt(variance of a sample * t / cost of a sample)
/// (the efficiency-optimised roulette of Veach 1997, section 10.4, per ray). As relative
/// errors weigh it, with the same relative variance in all pixels,
///   threshold_c = sqrt(I_c^2 + epsilon) * relative,   3 inverse_c^2 = 1 / threshold_c^2
/// relative: sqrt(relative variance of a sample * t / cost of a sample); 0 = trace all.
/// exposure: factor from what rays carry to the colours that `image` was made of.
AlignedVector<float> InverseShadowThreshold(const PilotImage& image, std::uint32_t pixels,
                                            double relative, double exposure);

/// Where light subpaths from infinity start, learned from what they bring to the image.
/// Across its direction, each distant light has a square of cells around the scene; the
/// infinite lights together have one for each of kSkyBins^2 directions of the octahedral
/// map.
struct EmissionGuide {
  static constexpr std::uint32_t kSunSide = 64, kSkySide = 16, kSkyBins = 8;
  /// Probability of starting on the whole disk, whatever has been learned.
  static constexpr float kDefensive = 0.1f;

  // Of the scene:
  AlignedVector<std::int32_t> distant;  // per light: its first cell; -1: none
  std::int32_t sky = -1;                // first cell of all infinite lights; -1: none
  std::uint32_t num_cells = 0;
  // Once it has learned; weights are what the tables are made of.
  std::vector<double> cell_weights, light_weights;
  LightStarts lights;
  // Per cell; an alias table of each square, with places in it.
  AlignedVector<float> pmf, alias_q;
  AlignedVector<std::uint32_t> alias;

  bool has_learned() const { return !pmf.empty(); }
};

struct StrategyTables {
  PathValues path_values;            // adjoint, efficiency: set by the training passes
  ShadowThreshold shadow_threshold;  // shadow-roulette=contribution: by a training pass
  EmissionGuide emission;            // light-paths=splats: by a training pass
};

/// Returns the tables that the scene's strategy needs, before training.
StrategyTables MakeStrategyTables(const PreparedScene& scene);

}  // namespace lanelight
