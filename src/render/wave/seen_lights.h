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
// see. These rays go through PhaseId::kVisibleLights, in the wavefront of the task's
// thread.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "src/render/wave/run_state.h"
#include "src/render/wave/seen_light_samples.h"
#include "src/render/wave/stage_clock.h"
#include "src/render/wave/wavefront.h"

namespace lanelight {

/// The samples of a task: values[plane * stride + pixel * count + i] is plane `plane` of
/// sample begin + i of pixels[pixel].
struct SeenLightTask {
  std::size_t tile = 0;
  const std::vector<std::uint32_t>& pixels;  // y * image width + x
  std::uint64_t begin = 0;                   // of the run's seed
  std::uint32_t count = 0;
  float* values = nullptr;
  std::size_t stride = 0;
};

/// What a thread has to follow camera rays to the light that they see.
class SeenLightRays {
 public:
  /// Samples of some pixels.
  struct Work {
    const std::uint32_t* pixels = nullptr;
    std::size_t num_pixels = 0;
    std::uint32_t seed = 0;
    std::uint64_t first = 0;
    std::uint32_t count = 0;
    bool finds_edges = false;  // by PhaseId::kFindEdges, if the plan has it
  };

  /// `plan` has PhaseId::kVisibleLights. Refers to all of these.
  SeenLightRays(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
                const Wavefront& wavefront);

  /// Overwrites `out`: plane by plane, of each the samples of one pixel after the other.
  void Trace(const Work& work, StageClock* clock, std::vector<float>& out);

  const RunParameters& image_run() const { return image_run_; }

  // Room for who calls.
  std::vector<std::uint32_t> pixels;
  std::vector<float> own, others;

 private:
  const PreparedScene& scene_;
  const Plan& plan_;
  const RunParameters& image_run_;
  const Phase &visible_, &edges_;  // may be the same
  RunParameters run_;
  Wave visible_wave_, edges_wave_;  // on the same columns
};

class SeenLightEdges {
 public:
  /// Of this many tiles. Refers to the scene.
  SeenLightEdges(const PreparedScene& scene, std::size_t tiles);

  /// Finds the edges in a tile of the image, once: whoever comes later waits. Safe from
  /// several threads, each with its rays. Before Correct() of this tile.
  void Find(std::size_t tile, const PixelRect& rect, SeenLightRays& rays,
            StageClock* clock);
  /// Corrects the samples of a task of a tile, if it has edges, and counts the rays. Safe
  /// from several threads. Whether anything was done.
  bool Correct(const SeenLightTask& task, SeenLightRays& rays, StageClock* clock,
               RunCounts& counts) const;

  /// Pixels of a tile with edges, as places in its TilePixels.
  const std::vector<std::uint32_t>& Of(std::size_t tile) const { return edges_[tile]; }

 private:
  /// Some of the places of a tile's edges.
  struct Places {
    const std::uint32_t* at = nullptr;
    std::size_t count = 0;
  };
  void FindIn(const PixelRect& rect, SeenLightRays& rays, StageClock* clock,
              std::vector<std::uint32_t>& edges) const;
  void CorrectPixels(const Places& places, const SeenLightTask& task, SeenLightRays& rays,
                     StageClock* clock) const;

  const PreparedScene& scene_;
  const SeenLightSamples samples_;
  const std::vector<std::uint32_t> small_lights_;  // pixels, ascending
  const int reach_;                                // pixels
  std::vector<std::vector<std::uint32_t>> edges_;  // by tile: places in its TilePixels
  std::vector<std::once_flag> found_;              // by tile
};

}  // namespace lanelight
