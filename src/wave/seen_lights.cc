#include "src/wave/seen_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/prepare/groups.h"
#include "src/strategy/choices.h"
#include "src/wave/seen_light_places.h"
#include "src/wave/drive.h"
#include "src/plan/plan_features.h"
#include "src/wave/tiles.h"

namespace lanelight {
namespace {

/// Camera rays of each pixel that find edges; those of its neighbours count as well.
constexpr std::uint32_t kFindRays = 8;
/// Emission that differs by less makes no rare sample.
constexpr float kLeastStep = 0.5f, kLeastRatio = 3;
/// Camera rays that are traced together at most, unless one pixel has more.
constexpr std::uint64_t kMostRays = 1u << 15;
/// Samples of the image under one seed of the further rays: their indices have 31 bits.
constexpr std::uint64_t kSamplesPerRaySeed = kSamplesPerSeed / kSeenLightRays;

/// Light at the end of what floats can say, and a light's edge on top of it.
constexpr double kLargest = std::numeric_limits<float>::max();
/// Where small lights lie, which may be hidden or be part of a larger one.
constexpr std::uint32_t kSmallLightRays = 256;

constexpr std::uint32_t kFindSeed = 0x2545f491u;

// Apart from the image's.
std::uint32_t RaySeed(std::uint32_t seed, std::uint64_t turn) {
  return (seed ^ 0x6a09e667u) + static_cast<std::uint32_t>(turn) * 0x9e3779b9u;
}

PlanOptions CameraOnly(PlanOptions options) {
  options.max_depth = 0;
  options.camera_only = true;
  options.auxiliary = Auxiliary::kNone;
  return options;
}

struct Range {
  float low = std::numeric_limits<float>::max(), high = 0;

  void Add(float value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void Add(const Range& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  bool IsEdge() const { return high - low > kLeastStep && high > kLeastRatio * low; }
};

PixelRect WithBorder(const PixelRect& tile, int border, int width, int height) {
  return {std::max(0, tile.x0 - border), std::max(0, tile.y0 - border),
          std::min(width, tile.x1 + border), std::min(height, tile.y1 + border)};
}

// How far pixels lie apart whose samples may see the same: neighbours, or what the filter
// reaches.
int Reach(const CompiledFilter& filter) {
  const double radius = std::max(filter.x_radius, filter.y_radius);
  return static_cast<int>(std::clamp(std::ceil(radius + 0.5), 1.0, 8.0));
}

// Ranges of what pixels of a window see.
class SeenRanges {
 public:
  SeenRanges(const PixelRect& window, std::uint32_t image_width)
      : window_(window), image_width_(image_width), ranges_(window.pixels()) {}

  // Camera rays of a pixel: `count` of each plane.
  void Add(std::uint32_t pixel, const float* values, std::size_t stride,
           std::size_t count) {
    auto& range = At(static_cast<int>(pixel % image_width_),
                     static_cast<int>(pixel / image_width_));
    for (std::size_t c = 0; c < kColorPlanes; ++c) {
      for (std::size_t i = 0; i < count; ++i) range[c].Add(values[c * stride + i]);
    }
  }
  // Whether what pixels up to `reach` away see differs much.
  bool IsEdge(std::uint32_t pixel, int reach) {
    const int x = static_cast<int>(pixel % image_width_),
              y = static_cast<int>(pixel / image_width_);
    std::array<Range, kColorPlanes> around;
    for (int b = std::max(window_.y0, y - reach); b < std::min(window_.y1, y + reach + 1);
         ++b) {
      for (int a = std::max(window_.x0, x - reach);
           a < std::min(window_.x1, x + reach + 1); ++a) {
        for (std::size_t c = 0; c < kColorPlanes; ++c) around[c].Add(At(a, b)[c]);
      }
    }
    return std::any_of(around.begin(), around.end(),
                       [](const Range& r) { return r.IsEdge(); });
  }

 private:
  std::array<Range, kColorPlanes>& At(int x, int y) {
    return ranges_[static_cast<std::size_t>(y - window_.y0) *
                       static_cast<std::size_t>(window_.width()) +
                   static_cast<std::size_t>(x - window_.x0)];
  }

  PixelRect window_;
  std::uint32_t image_width_;
  std::vector<std::array<Range, kColorPlanes>> ranges_;
};

}  // namespace

std::unique_ptr<SeenLightEdges> SeenLightEdges::Make(const CompiledScene& scene,
                                                     const PlanOptions& options,
                                                     const RunParameters& run) {
  if (!SeesLightsApart(scene)) return nullptr;
  return std::unique_ptr<SeenLightEdges>(new SeenLightEdges(scene, options, run));
}

SeenLightEdges::SeenLightEdges(const CompiledScene& scene, const PlanOptions& options,
                               const RunParameters& run)
    : scene_(scene),
      image_run_(run),
      plan_(MakePlan(scene, CameraOnly(options))),
      samples_{GroupsOf(scene.strategy), kSeenLightRays},
      small_lights_(PlacesOfSmallLights(scene)),
      reach_(Reach(scene.filter)),
      spaces_(static_cast<std::size_t>(ThreadSlots())) {}

SeenLightEdges::Space& SeenLightEdges::ThreadSpace() {
  auto& space = spaces_[static_cast<std::size_t>(ThreadIndex())];
  if (!space) {
    RunParameters run = MakeRunParameters(scene_, plan_);
    run.tables = image_run_.tables;
    space = std::make_unique<Space>(scene_, plan_, run);
  }
  return *space;
}

void SeenLightEdges::Trace(Space& space, const Rays& rays, std::vector<float>& out) {
  TileWork work;
  work.pixels = rays.pixels;
  work.num_pixels = static_cast<std::uint32_t>(rays.num_pixels);
  work.first_sample = static_cast<std::uint32_t>(rays.first);
  work.samples = rays.count;
  work.together = SamplesTogether(scene_, plan_);
  const std::size_t rows = rays.num_pixels * rays.count;
  out.resize(std::max(out.size(), rows * kColorPlanes));
  space.run.seed = rays.seed;
  Wave& wave = space.wavefront.wave();
  wave.rays_closest = wave.rays_shadow = 0;
  wave.health = {};
  Drive(space.wavefront, plan_, {work, {out.data(), static_cast<std::uint32_t>(rows)}},
        nullptr);
}

std::vector<std::uint32_t> SeenLightEdges::EdgesOf(const PixelRect& tile) {
  const auto width = static_cast<std::uint32_t>(scene_.film.width);
  const PixelRect all = WithBorder(tile, reach_, scene_.film.width, scene_.film.height);
  SeenRanges ranges(all, width);
  Space& space = ThreadSpace();
  TilePixels(all, scene_.film.width, &space.pixels);
  const std::size_t rows = space.pixels.size() * kFindRays;
  Trace(space, {space.pixels.data(), space.pixels.size(), kFindSeed, 0, kFindRays},
        space.others);
  for (std::size_t p = 0; p < space.pixels.size(); ++p) {
    ranges.Add(space.pixels[p], space.others.data() + p * kFindRays, rows, kFindRays);
  }
  for (const std::uint32_t pixel : space.pixels) {
    if (!std::binary_search(small_lights_.begin(), small_lights_.end(), pixel)) continue;
    Trace(space, {&pixel, 1, kFindSeed, 0, kSmallLightRays}, space.own);
    ranges.Add(pixel, space.own.data(), kSmallLightRays, kSmallLightRays);
  }
  TilePixels(tile, scene_.film.width, &space.pixels);
  std::vector<std::uint32_t> edges;
  for (std::size_t p = 0; p < space.pixels.size(); ++p) {
    if (!ranges.IsEdge(space.pixels[p], reach_)) continue;
    edges.push_back(static_cast<std::uint32_t>(p));
  }
  return edges;
}

void SeenLightEdges::Find(const std::vector<PixelRect>& tiles) {
  edges_.resize(tiles.size());
  ParallelFor(tiles.size(),
              [&](std::size_t tile) { edges_[tile] = EdgesOf(tiles[tile]); });
}

std::uint64_t SeenLightEdges::pixels() const {
  std::uint64_t sum = 0;
  for (const auto& edges : edges_) sum += edges.size();
  return sum;
}

bool SeenLightEdges::Correct(std::size_t tile, const SeenLightTask& task,
                             RunCounts& counts) {
  const std::vector<std::uint32_t>& edges = edges_[tile];
  if (edges.empty()) return false;
  Space& space = ThreadSpace();
  const std::uint64_t each =
      samples_.End(task.begin + task.count) - samples_.Begin(task.begin);
  const std::size_t most = std::max<std::size_t>(1, kMostRays / each);
  for (std::size_t first = 0; first < edges.size(); first += most) {
    CorrectPixels(space, edges.data() + first, std::min(most, edges.size() - first),
                  task);
  }
  // As many for any cut; those that others of a turn need are traced again.
  counts.rays_closest += edges.size() * task.count * (1 + kSeenLightRays);
  return true;
}

void SeenLightEdges::CorrectPixels(Space& space, const std::uint32_t* places,
                                   std::size_t count, const SeenLightTask& task) {
  space.pixels.clear();
  for (std::size_t p = 0; p < count; ++p) space.pixels.push_back(task.pixels[places[p]]);
  Trace(space, {space.pixels.data(), count, image_run_.seed, task.begin, task.count},
        space.own);
  const std::uint64_t end = task.begin + task.count;
  for (std::uint64_t begin = task.begin, next = 0; begin < end; begin = next) {
    const std::uint64_t turn = begin / kSamplesPerRaySeed;
    next = std::min(end, (turn + 1) * kSamplesPerRaySeed);
    const std::uint64_t base = turn * kSamplesPerRaySeed;
    const std::uint64_t first = samples_.Begin(begin - base);
    const auto rays = static_cast<std::uint32_t>(samples_.End(next - base) - first);
    Trace(space,
          {space.pixels.data(), count, RaySeed(image_run_.seed, turn), first, rays},
          space.others);
    for (std::size_t c = 0; c < kColorPlanes; ++c) {
      for (std::size_t p = 0; p < count; ++p) {
        const float* const own = space.own.data() + (c * count + p) * task.count;
        const float* const others = space.others.data() + (c * count + p) * rays;
        float* const values =
            task.values + c * task.stride + std::size_t{places[p]} * task.count;
        for (std::uint64_t i = begin; i < next; ++i) {
          double sum = 0;
          samples_.ForEach(i - base,
                           [&](std::uint64_t s) { sum += double(others[s - first]); });
          const auto at = static_cast<std::size_t>(i - task.begin);
          const double corrected =
              double(values[at]) - double(own[at]) + sum / samples_.Count();
          values[at] = static_cast<float>(std::clamp(corrected, -kLargest, kLargest));
        }
      }
    }
  }
}

}  // namespace lanelight
