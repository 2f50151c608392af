// pixel-samples=shared: the samples of a tile count for all of its pixels whose filters
// they lie under, not only for the pixel that they are drawn for.
//
// A sample of pixel q lies at x with the density g_q(x), the pixel filter around q. All
// pixels of a tile have equally many samples, so a pixel p has as many techniques as the
// tile has pixels. With the balance heuristic the sample adds to p
//
//   f(x) g_p(x) / sum over pixels r of the tile of g_r(x).
//
// The mean is that of own samples, whatever the tile. Where samples are independent, a
// filter of radius 1.5 and sigma 0.5 leaves a third of a pixel's variance; errors of
// neighbours are then alike. Samples of the same index are joined, so what is an
// observation stays one (SampleGroups). They lie at the same place of all filters
// (TileWork::tile_pixel), on a grid: inside a tile, their weights add up to 1.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/image/pixel_rect.h"
#include "src/scene/compiled/camera.h"
#include "src/scene/prepare/parameters.h"

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// The samples of a tile: values[plane * stride + place * count + i] is plane `plane` of
/// sample i of pixels[place]. `pixels`: TilePixels() of `tile`.
struct TilePlanes {
  PixelRect tile;
  const std::vector<std::uint32_t>& pixels;
  std::uint32_t count = 0;
  float* values = nullptr;
  std::size_t stride = 0;
};

class SampleSharing {
 public:
  explicit SampleSharing(const CompiledFilter& filter);

  /// Replaces the colours of all samples by what samples of their index add to their
  /// pixels. `places`: TileWork::filter_places.
  void Share(const TilePlanes& planes, const float* places);

  /// A sample of a task: of pixels[place].
  struct Target {
    std::size_t place = 0;
    std::uint32_t sample = 0;
  };
  /// Adds light of a sample at (x, y) in its pixel's filter to the samples of all pixels
  /// that it counts for. After Share() of the same tile.
  void Add(const TilePlanes& planes, const Target& of, float x, float y,
           const std::array<double, 3>& light);

  /// Returns what the filter makes of the correlations of pixels.
  FilterReach Reach() const;

 private:
  // The masses of the filter's bins along an axis, and the weights of pixels up to
  // `reach` from that of a sample.
  struct Axis {
    Axis(float radius, bool is_box, const AlignedVector<float>& cdf,
         const AlignedVector<float>& signs);
    std::size_t taps() const { return std::size_t(2 * reach + 1); }
    /// Writes the weights of pixels of which [low, high], relative to that of the sample,
    /// are in the tile: out[k * step] is that of pixel k - reach.
    void WeightsAt(float place, int low, int high, std::size_t step, float* out) const;
    /// Returns the covariances of pixels 0, 1, ... 2 reach apart, of samples of
    /// variance 1.
    std::vector<double> Covariances() const;

    std::array<float, CompiledFilter::kSize> mass{};  // signed
    float bins_per_pixel;
    int reach;
    std::vector<float> weights;  // by pixel of a line, tap and sample
  };
  static void Prepare(int pixels, std::uint32_t count, const float* places, Axis& axis);
  // Adds what samples of pixels along `axis` bring to one another. `from` and `to` have
  // the samples of a line of pixels, which are `step` apart.
  struct Line {
    const float* from = nullptr;
    float* to = nullptr;
    std::size_t step = 0;
    int pixels = 0;
  };
  static void ShareLine(const Axis& axis, std::uint32_t count, const Line& line);
  void FindPlaces(const TilePlanes& planes);

  Axis x_, y_;
  std::vector<std::uint32_t> row_order_;     // places of pixels, row by row
  std::vector<std::uint32_t> row_position_;  // by place: index in row_order_
  AlignedVector<float> rows_, along_x_;      // a plane, row by row
};

/// Returns what the scene's pixel filter makes of the correlations of pixels.
FilterReach ReachOfFilter(const PreparedScene& scene);

}  // namespace lanelight
