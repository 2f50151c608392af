// seen-lights=apart: in pixels at the edge of a light that the camera sees, the light's
// own emission is integrated by further camera rays, which cost a small part of a path.
// Of all that scatters in an image the edges of bright lights are the rarest and
// brightest: a lamp of radiance 17 that covers a hundredth of a pixel, say.
//
// Which pixels these are is a property of the scene: a few camera rays of each pixel and
// its neighbours tell, and more where a light lies that is smaller than pixels (with a
// seed of their own, so nothing is biased). What a path
// brings there is corrected when its task is done: less the emission that its own camera
// ray sees (traced again: the same numbers), plus the mean of what kSeenLightRays others
// see.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "src/wave/run_state.h"
#include "src/wave/seen_light_samples.h"
#include "src/wave/wavefront.h"

namespace lanelight {

/// The samples of a task: values[plane * stride + pixel * count + i] is plane `plane` of
/// sample begin + i of pixels[pixel].
struct SeenLightTask {
  const std::vector<std::uint32_t>& pixels;  // y * image width + x
  std::uint64_t begin = 0;                   // of the run's seed
  std::uint32_t count = 0;
  float* values = nullptr;
  std::size_t stride = 0;
};

class SeenLightEdges {
 public:
  /// Null where no light can be seen, or the strategy does not ask for it. Refers to all
  /// of these; the seed of `run` may change between tasks.
  static std::unique_ptr<SeenLightEdges> Make(const CompiledScene& scene,
                                              const PlanOptions& options,
                                              const RunParameters& run);

  /// Finds the edges in tiles of the image, in parallel. Before any Correct().
  void Find(const std::vector<PixelRect>& tiles);
  /// Corrects the samples of a task of a tile, if it has edges, and counts the rays. Safe
  /// from several threads. Whether anything was done.
  bool Correct(std::size_t tile, const SeenLightTask& task, RunCounts& counts);

  /// Pixels of a tile with edges, as places in its TilePixels.
  const std::vector<std::uint32_t>& Of(std::size_t tile) const { return edges_[tile]; }
  /// Pixels of all tiles with edges.
  std::uint64_t pixels() const;

 private:
  /// What a thread has of its own.
  struct Space {
    Space(const CompiledScene& scene, const Plan& plan, const RunParameters& run)
        : run(run), wavefront(scene, plan, this->run) {}
    RunParameters run;
    Wavefront wavefront;
    std::vector<std::uint32_t> pixels;
    std::vector<float> own, others;
  };
  /// Camera rays of samples of some pixels.
  struct Rays {
    const std::uint32_t* pixels = nullptr;
    std::size_t num_pixels = 0;
    std::uint32_t seed = 0;
    std::uint64_t first = 0;
    std::uint32_t count = 0;
  };

  SeenLightEdges(const CompiledScene& scene, const PlanOptions& options,
                 const RunParameters& run);
  Space& ThreadSpace();
  void Trace(Space& space, const Rays& rays, std::vector<float>& out);
  std::vector<std::uint32_t> EdgesOf(const PixelRect& tile);
  void CorrectPixels(Space& space, const std::uint32_t* places, std::size_t count,
                     const SeenLightTask& task);

  const CompiledScene& scene_;
  const RunParameters& image_run_;
  const Plan plan_;
  const SeenLightSamples samples_;
  const std::vector<std::uint32_t> small_lights_;  // pixels, ascending
  const int reach_;                                // pixels
  std::vector<std::vector<std::uint32_t>> edges_;  // by tile: places in its TilePixels
  std::vector<std::unique_ptr<Space>> spaces_;
};

}  // namespace lanelight
