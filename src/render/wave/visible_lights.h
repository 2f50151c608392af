// seen-lights=apart: in pixels at the edge of a light that the camera sees, the light's
// own emission is integrated by further camera rays, which cost a small part of a path.
// Edges of bright lights are the rarest and brightest noise of an image: a lamp of
// radiance 17 that covers a hundredth of a pixel, say.
//
// Which pixels these are is a property of the scene. A few camera rays of each pixel and
// its neighbours tell, and more around lights smaller than pixels; they have their own
// seed, so nothing is biased. A path's pixel is corrected at the end of its task: minus
// the emission that its own camera ray sees (traced again with the same numbers), plus
// the mean emission that kVisibleLightRays others see. These rays run
// PhaseId::kVisibleLights in the wavefront of the task's thread.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "src/render/wave/run_state.h"
#include "src/render/wave/shared_samples.h"
#include "src/render/wave/stage_clock.h"
#include "src/render/wave/wavefront.h"
#include "src/vocabulary/path/replicates.h"

namespace lanelight {

/// The samples of a task.
struct VisibleLightTask {
  std::size_t tile = 0;
  const TilePlanes& planes;
  std::uint64_t begin = 0;  // the first sample, of the run's seed
};

/// Traces camera rays to the light that they see; one object per thread.
class VisibleLightRays {
 public:
  struct Work {
    const std::uint32_t* pixels = nullptr;
    std::size_t num_pixels = 0;
    std::uint32_t seed = 0;
    std::uint64_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t tile_pixel = 0;  // TileWork::tile_pixel
    bool finds_edges = false;      // by PhaseId::kFindEdges, if the plan has it
  };

  /// `plan` has PhaseId::kVisibleLights. Refers to all of these.
  VisibleLightRays(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
                   const Wavefront& wavefront);

  /// Overwrites `out`: plane by plane, in each the samples of one pixel after the other.
  void Trace(const Work& work, StageClock* clock, std::vector<float>& out);

  const RunParameters& image_run() const { return image_run_; }

  // Scratch memory of the caller.
  std::vector<std::uint32_t> pixels;
  std::vector<float> own, others;
  std::vector<float> filter_places;  // of the last Trace(), with pixel-samples=shared

 private:
  const PreparedScene& scene_;
  const Plan& plan_;
  const RunParameters& image_run_;
  const Phase &visible_, &edges_;  // may be the same
  RunParameters run_;
  Wave visible_wave_, edges_wave_;  // on the same columns
};

/// Sample i of a path's pixel takes the mean of `rays` samples of another stream that has
/// `rays` times as many. Both count as observations in the same way (SampleGroups), and
/// what a path takes belongs to the replicate of the path, so that observations stay
/// independent. Within an observation the stream's points are taken in their order: n
/// paths have its first n * rays.
struct VisibleLightSamples {
  SampleGroups groups;
  std::uint32_t rays = 1;

  /// Samples that take turns.
  std::uint32_t SamplesPerRound() const {
    return groups.unit * (groups.replicates ? kReplicates : 1);
  }
  /// Return the range of the stream for the paths [begin, end) and those that take turns
  /// with them.
  std::uint64_t Begin(std::uint64_t begin) const {
    return begin / SamplesPerRound() * SamplesPerRound() * rays;
  }
  std::uint64_t End(std::uint64_t end) const {
    return (end + SamplesPerRound() - 1) / SamplesPerRound() * SamplesPerRound() * rays;
  }
  /// Calls body(sample) for the rays * unit samples of the stream that path i takes the
  /// mean of; paths of one unit share theirs.
  template <class Body>
  void ForEach(std::uint64_t i, const Body& body) const {
    const std::uint64_t others = groups.replicates ? kReplicates : 1;
    const std::uint64_t unit = i / groups.unit;
    const std::uint64_t replicate = unit % others, place = unit / others;
    for (std::uint32_t k = 0; k < rays; ++k) {
      const std::uint64_t own = (place * rays + k) * others + replicate;
      for (std::uint32_t j = 0; j < groups.unit; ++j) body(own * groups.unit + j);
    }
  }
  double Count() const { return double(rays) * groups.unit; }
};

class VisibleLightEdges {
 public:
  /// Makes room for this many tiles. Refers to the scene.
  VisibleLightEdges(const PreparedScene& scene, std::size_t tiles);

  /// Finds the edges in a tile of the image, once; other threads that call it wait. Safe
  /// from several threads, each with its own rays. Before Correct() of this tile.
  void Find(std::size_t tile, const PixelRect& rect, VisibleLightRays& rays,
            StageClock* clock);
  /// Takes the emission that their own camera rays see from the samples of a task, if its
  /// tile has edges. Safe from several threads. Returns whether anything was done.
  bool RemoveOwn(const VisibleLightTask& task, VisibleLightRays& rays,
                 StageClock* clock) const;
  /// Adds the mean emission that other camera rays see; by `sharing` to all pixels that
  /// these count for, unless it is null. Safe from several threads.
  void AddOthers(const VisibleLightTask& task, SampleSharing* sharing,
                 VisibleLightRays& rays, StageClock* clock) const;
  /// Returns the rays of both for so many samples. They are the same for any split of the
  /// work; rays that others of a turn need are traced again.
  std::uint64_t RaysOf(std::size_t tile, std::uint32_t samples) const {
    return edges_[tile].size() * samples * (1 + std::uint64_t{kVisibleLightRays});
  }

  /// Returns the pixels of a tile with edges, as places in its TilePixels.
  const std::vector<std::uint32_t>& Of(std::size_t tile) const { return edges_[tile]; }

 private:
  /// Some of the places of a tile's edges.
  struct Places {
    const std::uint32_t* at = nullptr;
    std::size_t count = 0;
  };
  void FindIn(const PixelRect& rect, VisibleLightRays& rays, StageClock* clock,
              std::vector<std::uint32_t>& edges) const;
  // A range of a stream's samples [begin, end), whose camera rays begin with `first` and
  // number `count` for each pixel; `offset`: of `begin` in the task.
  struct Stream {
    std::uint64_t begin = 0, end = 0, offset = 0;
    std::uint64_t first = 0;
    std::uint32_t count = 0;
  };
  void AddStream(const Stream& stream, const Places& places, const TilePlanes& planes,
                 const VisibleLightRays& rays, SampleSharing* sharing) const;
  /// Calls visit(places) for groups of the tile's edges that are traced together, whose
  /// pixels are then listed in `rays`.
  template <class Visit>
  void ForEachGroup(const VisibleLightTask& task, VisibleLightRays& rays,
                    const Visit& visit) const;

  const PreparedScene& scene_;
  const VisibleLightSamples samples_;
  const std::vector<std::uint32_t> small_lights_;  // pixels, ascending
  const int reach_;                                // pixels
  std::vector<std::vector<std::uint32_t>> edges_;  // by tile: places in its TilePixels
  std::vector<std::once_flag> found_;              // by tile
};

/// Returns pixels (y * image width + x, ascending, each once) that may see an emitting
/// shape whose picture has a radius below kSmallLight pixels, hidden or not, in focus or
/// not. Shapes at or behind the camera have no picture.
std::vector<std::uint32_t> PlacesOfSmallLights(const PreparedScene& scene);
inline constexpr double kSmallLight = 2;

}  // namespace lanelight
