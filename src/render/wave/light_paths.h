// light-paths=splats: the light subpaths of a task, and what they bring to pixels
// (src/vocabulary/path/light_splats.h).
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/image/pixel_rect.h"
#include "src/render/films/splat_film.h"
#include "src/render/plan/plan.h"
#include "src/render/wave/stage_clock.h"
#include "src/render/wave/wavefront.h"
#include "src/vocabulary/path/light_splats.h"

namespace lanelight {

/// Returns the unit of the sums of light subpaths: a power of two, in proportion to the
/// power of the lights at which they start over the solid angle of the image. Returns 1
/// if they start nowhere.
double SplatUnit(const PreparedScene& scene);

/// Returns the sum over all pixels of the correlation of their splats with those of one
/// pixel, if subpaths splat once: (integral of f)^2 / integral of f^2, in pixels, f being
/// the pixel filter. The sum of squared correlations (SampleGroups::dependents) is less.
double SplatPixels(const PreparedScene& scene);

class LightSubpaths {
 public:
  /// For a plan with kLightPaths, and an image of these pixels.
  LightSubpaths(const PreparedScene& scene, const Plan& plan, const PixelRect& window,
                Wavefront& wavefront);

  /// Returns the number of light subpaths of a pixel for its samples [first, first +
  /// count): one for each whose index is a multiple of N.
  std::uint32_t PathsOf(std::uint64_t first, std::uint32_t count) const;
  /// Traces the subpaths of a task whose camera paths have ended. Adds rays and problems
  /// to the counts of `paths`.
  void Trace(const TileWork& work, Wave& paths, StageClock* clock,
             std::vector<PixelSplat>& out);
  /// Traces one subpath for each sample, and keeps where it starts (LightSplats::starts):
  /// visit(start, light) is called for each, with the sum of what it brings to the film.
  template <class Visit>
  void TraceStarts(const TileWork& work, Wave& paths, const Visit& visit) {
    const std::size_t count = std::size_t{work.num_pixels} * work.samples;
    starts_.assign(count, 0);
    splats_.starts = starts_.data();
    TraceVertices(work, paths, nullptr);
    for (std::size_t path = 0; path < count; ++path) {
      double light = 0;
      for (std::size_t v = 0; v < kMaxLightVertices; ++v) {
        const std::size_t entry = path * kMaxLightVertices + v;
        if (splats_.present[entry] == 0) continue;
        for (const float* c : splats_.light) light += double(c[entry]);
      }
      visit(starts_[path], light);
    }
  }
  /// Calls visit(subpath, share, splats) for each vertex of the last task that the camera
  /// sees: the MIS weight of camera paths there, and what it brings to pixels. Subpaths
  /// of a pixel are consecutive.
  template <class Visit>
  void ForEachVertex(std::size_t paths, const Visit& visit) {
    std::vector<PixelSplat> splats;
    for (std::size_t e = 0; e < paths * kMaxLightVertices; ++e) {
      if (splats_.present[e] == 0) continue;
      splats.clear();
      AddEntry(e, 0, splats);
      visit(e / kMaxLightVertices, splats_.share[e], splats);
    }
  }

 private:
  void TraceVertices(const TileWork& work, Wave& paths, StageClock* clock);
  void MakeRoom(std::size_t paths);
  void Filter(std::size_t path, std::vector<PixelSplat>& out);
  bool IsApart(std::size_t entry, std::size_t path) const;
  void AddEntry(std::size_t entry, std::size_t first, std::vector<PixelSplat>& out);

  const Plan& plan_;
  const std::uint32_t samples_per_path_;
  const PixelRect window_;
  const float scale_;  // from radiance and pixels of the image to the sums' unit
  RunParameters run_;
  Wave light_;  // in the memory of the wavefront
  LightSplats splats_;
  std::size_t room_ = 0;
  UntouchedVector<std::uint32_t> entries_;
  std::vector<float> column_, row_;  // values of the filter
  std::vector<std::uint32_t> starts_;
};

}  // namespace lanelight
