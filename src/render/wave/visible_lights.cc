#include "src/render/wave/visible_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/render/wave/phase_driver.h"
#include "src/render/wave/task_runner.h"
#include "src/render/wave/tiles.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/vocabulary/strategy/choices.h"

namespace lanelight {
namespace {

/// Camera rays of each pixel that find edges; those of its neighbours count as well.
constexpr std::uint32_t kFindRays = 8;
/// Emission that differs by less makes no rare sample.
constexpr float kMinStep = 0.5f, kMinRatio = 3;
/// Camera rays that are traced together at most, unless one pixel has more.
constexpr std::uint64_t kMaxRays = 1u << 15;
/// Samples of the image under one seed of the further rays: their indices have 31 bits.
constexpr std::uint64_t kSamplesPerRaySeed = kSamplesPerSeed / kVisibleLightRays;

/// Largest finite values: a light's edge is added to the largest light.
constexpr float kLargest = std::numeric_limits<float>::max();
/// Rays for pixels with small lights, which may be hidden or be part of a larger light.
constexpr std::uint32_t kSmallLightRays = 256;

constexpr std::uint32_t kFindSeed = 0x2545f491u;

// Apart from the image's.
std::uint32_t RaySeed(std::uint32_t seed, std::uint64_t round) {
  return (seed ^ 0x6a09e667u) + std::uint32_t(round) * 0x9e3779b9u;
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
  bool IsEdge() const { return high - low > kMinStep && high > kMinRatio * low; }
};

PixelRect WithBorder(const PixelRect& tile, int border, int width, int height) {
  return {std::max(0, tile.x0 - border), std::max(0, tile.y0 - border),
          std::min(width, tile.x1 + border), std::min(height, tile.y1 + border)};
}

// Returns the distance of pixels whose samples may see the same: neighbours, or the
// radius of the filter.
int Reach(const CompiledFilter& filter) {
  const double radius = std::max(filter.x_radius, filter.y_radius);
  return int(std::clamp(std::ceil(radius + 0.5), 1.0, 8.0));
}

// Ranges of what pixels of a window see.
class VisibleRanges {
 public:
  VisibleRanges(const PixelRect& window, std::uint32_t image_width)
      : window_(window), image_width_(image_width), ranges_(window.pixels()) {}

  // Camera rays of a pixel: `count` of each plane.
  void Add(std::uint32_t pixel, const float* values, std::size_t stride,
           std::size_t count) {
    auto& range = At(int(pixel % image_width_), int(pixel / image_width_));
    for (std::size_t c = 0; c < kColorPlanes; ++c) {
      for (std::size_t i = 0; i < count; ++i) range[c].Add(values[c * stride + i]);
    }
  }
  // Returns whether what pixels up to `reach` away see differs much.
  bool IsEdge(std::uint32_t pixel, int reach) {
    const int x = int(pixel % image_width_), y = int(pixel / image_width_);
    std::array<Range, kColorPlanes> around;
    for (int b = std::max(window_.y0, y - reach); b < std::min(window_.y1, y + reach + 1);
         ++b) {
      for (int a = std::max(window_.x0, x - reach);
           a < std::min(window_.x1, x + reach + 1); ++a) {
        for (std::size_t c = 0; c < kColorPlanes; ++c) around[c].Add(At(a, b)[c]);
      }
    }
    return std::ranges::any_of(around, [](const Range& r) { return r.IsEdge(); });
  }

 private:
  std::array<Range, kColorPlanes>& At(int x, int y) {
    return ranges_[std::size_t(y - window_.y0) * std::size_t(window_.width()) +
                   std::size_t(x - window_.x0)];
  }

  PixelRect window_;
  std::uint32_t image_width_;
  std::vector<std::array<Range, kColorPlanes>> ranges_;
};

// Light that camera rays have found: rows of one pixel after the other, by plane.
struct FoundLight {
  const std::vector<float>& values;
  std::size_t stride = 0;

  std::array<float, kColorPlanes> At(std::size_t row) const {
    return {values[row], values[stride + row], values[2 * stride + row]};
  }
};

// Adds light to one sample of a pixel.
void AddTo(const TilePlanes& planes, std::size_t at,
           const std::array<double, kColorPlanes>& light) {
  for (std::size_t c = 0; c < kColorPlanes; ++c) {
    float& value = planes.values[c * planes.stride + at];
    value =
        float(std::clamp(double(value) + light[c], -double(kLargest), double(kLargest)));
  }
}

}  // namespace

VisibleLightRays::VisibleLightRays(const PreparedScene& scene, const Plan& plan,
                                   const RunParameters& run, const Wavefront& wavefront)
    : scene_(scene),
      plan_(plan),
      image_run_(run),
      visible_(*plan.Find(PhaseId::kVisibleLights)),
      edges_(plan.Find(PhaseId::kFindEdges) ? *plan.Find(PhaseId::kFindEdges) : visible_),
      visible_wave_(wavefront.Narrowed(visible_.features)),
      edges_wave_(wavefront.Narrowed(edges_.features)) {
  visible_wave_.run = edges_wave_.run = &run_;
}

void VisibleLightRays::Trace(const Work& rays, StageClock* clock,
                             std::vector<float>& out) {
  TileWork work;
  work.pixels = rays.pixels;
  work.num_pixels = std::uint32_t(rays.num_pixels);
  work.first_sample = std::uint32_t(rays.first);
  work.samples = rays.count;
  work.together = SamplesTogether(scene_, plan_);
  const std::size_t rows = rays.num_pixels * rays.count;
  out.resize(std::max(out.size(), rows * kColorPlanes));
  filter_places.resize(std::size_t{2} * rays.count);
  work.tile_pixel = rays.tile_pixel;
  work.filter_places = filter_places.data();
  run_ = image_run_;
  run_.seed = rays.seed;
  run_.max_depth = 0;
  run_.candidates = 1;
  const Phase& phase = rays.finds_edges ? edges_ : visible_;
  Wave& wave = rays.finds_edges ? edges_wave_ : visible_wave_;
  run_.features = phase.features;
  run_.planes = SamplePlanes(phase.features);
  wave.Begin(work, {out.data(), std::uint32_t(rows)});
  if (clock) clock->FinishPart(TaskPart::kSetUp, rows);
  RunPhase(wave, phase, clock);
}

VisibleLightEdges::VisibleLightEdges(const PreparedScene& scene, std::size_t tiles)
    : scene_(scene),
      samples_{GroupsOf(scene.strategy), kVisibleLightRays},
      small_lights_(PlacesOfSmallLights(scene)),
      reach_(Reach(scene.compiled->filter)),
      edges_(tiles),
      found_(tiles) {}

void VisibleLightEdges::Find(std::size_t tile, const PixelRect& rect,
                             VisibleLightRays& rays, StageClock* clock) {
  std::call_once(found_[tile], [&] { FindIn(rect, rays, clock, edges_[tile]); });
}

void VisibleLightEdges::FindIn(const PixelRect& rect, VisibleLightRays& rays,
                               StageClock* clock,
                               std::vector<std::uint32_t>& edges) const {
  const auto width = std::uint32_t(scene_.view->film.width);
  const PixelRect all =
      WithBorder(rect, reach_, scene_.view->film.width, scene_.view->film.height);
  VisibleRanges ranges(all, width);
  std::vector<std::uint32_t>& pixels = rays.pixels;
  TilePixels(all, scene_.view->film.width, &pixels);
  const std::size_t rows = pixels.size() * kFindRays;
  rays.Trace(
      {pixels.data(), pixels.size(), kFindSeed, 0, kFindRays, pixels.front(), true},
      clock, rays.others);
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    ranges.Add(pixels[p], rays.others.data() + p * kFindRays, rows, kFindRays);
  }
  for (const std::uint32_t pixel : pixels) {
    if (!std::ranges::binary_search(small_lights_, pixel)) continue;
    rays.Trace({&pixel, 1, kFindSeed, 0, kSmallLightRays, pixel, true}, clock, rays.own);
    ranges.Add(pixel, rays.own.data(), kSmallLightRays, kSmallLightRays);
  }
  TilePixels(rect, scene_.view->film.width, &pixels);
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    if (!ranges.IsEdge(pixels[p], reach_)) continue;
    edges.push_back(std::uint32_t(p));
  }
}

template <class Visit>
void VisibleLightEdges::ForEachGroup(const VisibleLightTask& task, VisibleLightRays& rays,
                                     const Visit& visit) const {
  const std::vector<std::uint32_t>& edges = edges_[task.tile];
  const std::uint64_t each =
      samples_.End(task.begin + task.planes.count) - samples_.Begin(task.begin);
  const std::size_t maximum = std::max<std::size_t>(1, kMaxRays / each);
  for (std::size_t first = 0; first < edges.size(); first += maximum) {
    const Places places = {edges.data() + first, std::min(maximum, edges.size() - first)};
    rays.pixels.clear();
    for (std::size_t p = 0; p < places.count; ++p) {
      rays.pixels.push_back(task.planes.pixels[places.at[p]]);
    }
    visit(places);
  }
}

bool VisibleLightEdges::RemoveOwn(const VisibleLightTask& task, VisibleLightRays& rays,
                                  StageClock* clock) const {
  const TilePlanes& planes = task.planes;
  ForEachGroup(task, rays, [&](const Places& places) {
    rays.Trace({rays.pixels.data(), places.count, rays.image_run().seed, task.begin,
                planes.count, planes.pixels.front()},
               clock, rays.own);
    for (std::size_t c = 0; c < kColorPlanes; ++c) {
      for (std::size_t p = 0; p < places.count; ++p) {
        const float* const own = rays.own.data() + (c * places.count + p) * planes.count;
        float* const values =
            planes.values + c * planes.stride + std::size_t{places.at[p]} * planes.count;
        for (std::size_t i = 0; i < planes.count; ++i) {
          values[i] = std::clamp(values[i] - own[i], -kLargest, kLargest);
        }
      }
    }
  });
  return !edges_[task.tile].empty();
}

void VisibleLightEdges::AddOthers(const VisibleLightTask& task, SampleSharing* sharing,
                                  VisibleLightRays& rays, StageClock* clock) const {
  ForEachGroup(task, rays, [&](const Places& places) {
    const std::uint64_t end = task.begin + task.planes.count;
    for (std::uint64_t begin = task.begin, next = 0; begin < end; begin = next) {
      const std::uint64_t round = begin / kSamplesPerRaySeed;
      next = std::min(end, (round + 1) * kSamplesPerRaySeed);
      const std::uint64_t base = round * kSamplesPerRaySeed;
      Stream stream = {begin - base, next - base, begin - task.begin};
      stream.first = samples_.Begin(stream.begin);
      stream.count = std::uint32_t(samples_.End(stream.end) - stream.first);
      rays.Trace({rays.pixels.data(), places.count, RaySeed(rays.image_run().seed, round),
                  stream.first, stream.count, task.planes.pixels.front()},
                 clock, rays.others);
      AddStream(stream, places, task.planes, rays, sharing);
    }
  });
}

void VisibleLightEdges::AddStream(const Stream& stream, const Places& places,
                                  const TilePlanes& planes, const VisibleLightRays& rays,
                                  SampleSharing* sharing) const {
  const FoundLight found = {rays.others, places.count * stream.count};
  const double share = 1 / samples_.Count();
  for (std::size_t p = 0; p < places.count; ++p) {
    for (std::uint64_t i = stream.begin; i < stream.end; ++i) {
      const auto at = std::uint32_t(i - stream.begin + stream.offset);
      std::array<double, kColorPlanes> mean = {};
      samples_.ForEach(i, [&](std::uint64_t s) {
        const auto ray = std::size_t(s - stream.first);
        const auto light = found.At(p * stream.count + ray);
        for (std::size_t c = 0; c < kColorPlanes; ++c)
          mean[c] += double(light[c]) * share;
        if (sharing == nullptr) return;
        const float* const place = rays.filter_places.data() + ray;
        sharing->Add(planes, {places.at[p], at}, place[0], place[stream.count], mean);
        mean = {};
      });
      AddTo(planes, std::size_t{places.at[p]} * planes.count + at, mean);
    }
  }
}

}  // namespace lanelight
