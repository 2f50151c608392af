#include "src/render/wave/light_paths.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/pi.h"
#include "src/render/plan/plan_features.h"
#include "src/render/wave/phase_driver.h"
#include "src/scene/compiled/camera.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kLightSeed = 0x3c6ef372u;
// Larger contributions do not fit the sums.
constexpr float kMaxSplat = 0x1p15f;
// White vertices at distance 1 from the camera bring about one part in this of the unit.
// Some bring far more: near the camera, by smooth metals, of bright parts of images.
constexpr double kHeadroom = 256;

// One axis of the pixel filter.
struct FilterAxis {
  float radius;
  bool is_box;
  const AlignedVector<float>&cdf, &sign;

  // Appends the filter's values, over its integral, at the pixels [begin, end) that a
  // point of the film reaches; returns the first of these.
  int Weigh(float at, int begin, int end, std::vector<float>& weights) const {
    weights.clear();
    const int first = int(std::clamp(std::floor(at - radius), float(begin), float(end)));
    const float density = 1 / (2 * radius);
    for (int pixel = first; pixel < end; ++pixel) {
      const float place = (at + radius - float(pixel)) * density;
      if (place < 0) break;
      weights.push_back(place < 1 ? At(place) * density : 0);
    }
    return first;
  }
  double Pixels() const {
    double sum = 0, squares = 0;
    for (int bin = 0; bin < CompiledFilter::kSize; ++bin) {
      const double f = At((float(bin) + 0.5f) / CompiledFilter::kSize);
      sum += f;
      squares += f * f;
    }
    return 2 * radius * sum * sum / (CompiledFilter::kSize * squares);
  }

 private:
  float At(float place) const {
    if (is_box) return 1;
    const auto bin = static_cast<std::size_t>(place * CompiledFilter::kSize);
    return (cdf[bin + 1] - cdf[bin]) * CompiledFilter::kSize * sign[bin];
  }
};

FilterAxis AlongX(const CompiledFilter& f) {
  return {f.x_radius, f.is_box, f.x_cdf, f.x_sign};
}
FilterAxis AlongY(const CompiledFilter& f) {
  return {f.y_radius, f.is_box, f.y_cdf, f.y_sign};
}

// Returns the splat of a pixel, from `first` on.
PixelSplat& SplatOf(std::uint32_t pixel, std::size_t first,
                    std::vector<PixelSplat>& out) {
  for (std::size_t i = first; i < out.size(); ++i) {
    if (out[i].pixel == pixel) return out[i];
  }
  return out.emplace_back(PixelSplat{pixel});
}

// Filters with negative lobes have more than their integral in their bins.
float ScaleOf(const PreparedScene& scene, const PixelRect& window) {
  const CompiledFilter& filter = scene.compiled->filter;
  const float sum = filter.is_box ? 1 : filter.weight;
  return sum * ExposureOf(scene) / float(double(window.pixels()) * SplatUnit(scene));
}

// Sets a splat to zero that is not a number or too large, and counts it.
void CheckSplat(PixelSplat& splat, Health& health) {
  float largest = 0;
  bool is_number = true;
  for (const float light : splat.light) {
    is_number = is_number && !std::isnan(light);
    largest = std::max(largest, std::abs(light));
  }
  if (is_number && largest <= kMaxSplat) return;
  is_number ? ++health.infinite : ++health.nan;
  std::fill_n(splat.light, 3, 0.0f);
}

}  // namespace

double SplatUnit(const PreparedScene& scene) {
  const AlignedVector<float>& pmf = scene.chances->emission.pmf;
  if (pmf.empty()) return 1;
  const std::vector<double>& powers = scene.compiled->lights.power;
  double power = 0;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (pmf[i] > 0) power += powers[i];
  }
  const CompiledCamera& camera = scene.view->camera;
  const Film& film = scene.view->film;
  const double pixel = double(camera.dx.x) * double(camera.dy.y) -
                       double(camera.dx.y) * double(camera.dy.x);
  const double image = std::abs(pixel) * film.width * film.height;
  const double unit = kHeadroom * power / (kPi * image) * double(ExposureOf(scene));
  return unit > 0 && unit < 1e300 ? std::exp2(std::round(std::log2(unit))) : 1;
}

double SplatPixels(const PreparedScene& scene) {
  const CompiledFilter& filter = scene.compiled->filter;
  return AlongX(filter).Pixels() * AlongY(filter).Pixels();
}

LightSubpaths::LightSubpaths(const PreparedScene& scene, const Plan& plan,
                             const PixelRect& window, Wavefront& wavefront)
    : plan_(plan),
      samples_per_path_(PlannedStrategy(scene, plan.options).light_path_samples),
      window_(window),
      scale_(ScaleOf(scene, window)),
      light_(wavefront.Narrowed(plan.Find(PhaseId::kLightPaths)->features)) {
  splats_.paths_per_sample = float(window.pixels()) / float(samples_per_path_);
  const CompiledFilter& filter = *light_.filter;
  splats_.x0 = float(window.x0) + 0.5f - filter.x_radius;
  splats_.x1 = float(window.x1) - 0.5f + filter.x_radius;
  splats_.y0 = float(window.y0) + 0.5f - filter.y_radius;
  splats_.y1 = float(window.y1) - 0.5f + filter.y_radius;
  wavefront.wave().light_splats = &splats_;
  light_.light_splats = &splats_;
  light_.run = &run_;
}

std::uint32_t LightSubpaths::PathsOf(std::uint64_t first, std::uint32_t count) const {
  const std::uint64_t n = samples_per_path_;
  return std::uint32_t((first + count + n - 1) / n - (first + n - 1) / n);
}

void LightSubpaths::MakeRoom(std::size_t paths) {
  const std::size_t entries = paths * kMaxLightVertices;
  if (paths > room_) {
    room_ = paths;
    entries_.resize(7 * entries);
  }
  std::uint32_t* next = entries_.data();
  splats_.present = next;
  for (float** column : {&splats_.x, &splats_.y, &splats_.light[0], &splats_.light[1],
                         &splats_.light[2], &splats_.share}) {
    next += entries;
    *column = reinterpret_cast<float*>(next);
  }
  std::fill_n(splats_.present, entries, 0u);
}

void LightSubpaths::Trace(const TileWork& work, Wave& paths, StageClock* clock,
                          std::vector<PixelSplat>& out) {
  out.clear();
  TileWork light = work;
  light.first_sample = (work.first_sample + samples_per_path_ - 1) / samples_per_path_;
  light.samples = PathsOf(work.first_sample, work.samples);
  light.together = 1;
  light.next_pixel = light.next_sample = 0;
  if (light.samples == 0) return;
  TraceVertices(light, paths, clock);
  const std::size_t count = std::size_t{light.num_pixels} * light.samples;
  for (std::size_t path = 0; path < count; ++path) Filter(path, out);
  for (PixelSplat& splat : out) CheckSplat(splat, paths.health);
}

void LightSubpaths::TraceVertices(const TileWork& work, Wave& paths, StageClock* clock) {
  MakeRoom(std::size_t{work.num_pixels} * work.samples);
  const Phase& phase = *plan_.Find(PhaseId::kLightPaths);
  run_ = *paths.run;
  run_.seed ^= kLightSeed;
  run_.features = phase.features;
  run_.max_depth = std::min(run_.max_depth, kMaxLightVertices);
  light_.rays_closest = light_.rays_shadow = 0;
  light_.Begin(work, {});
  RunPhase(light_, phase, clock);
  paths.rays_closest += light_.rays_closest;
  paths.rays_shadow += light_.rays_shadow;
}

// Adds what a subpath brings, once for each pixel.
void LightSubpaths::Filter(std::size_t path, std::vector<PixelSplat>& out) {
  const std::size_t begin = out.size();
  for (std::size_t v = 0; v < kMaxLightVertices; ++v) {
    const std::size_t entry = path * kMaxLightVertices + v;
    if (splats_.present[entry] == 0) continue;
    AddEntry(entry, IsApart(entry, path) ? out.size() : begin, out);
  }
}

// Returns whether no earlier entry of the subpath can be in the same pixels.
bool LightSubpaths::IsApart(std::size_t entry, std::size_t path) const {
  const CompiledFilter& filter = *light_.filter;
  for (std::size_t e = path * kMaxLightVertices; e < entry; ++e) {
    if (splats_.present[e] != 0 &&
        std::abs(splats_.x[e] - splats_.x[entry]) <= 2 * filter.x_radius + 1 &&
        std::abs(splats_.y[e] - splats_.y[entry]) <= 2 * filter.y_radius + 1) {
      return false;
    }
  }
  return true;
}

void LightSubpaths::AddEntry(std::size_t entry, std::size_t first,
                             std::vector<PixelSplat>& out) {
  const CompiledFilter& filter = *light_.filter;
  const int x =
      AlongX(filter).Weigh(splats_.x[entry] - 0.5f, window_.x0, window_.x1, column_);
  const int y =
      AlongY(filter).Weigh(splats_.y[entry] - 0.5f, window_.y0, window_.y1, row_);
  const float light[3] = {splats_.light[0][entry] * scale_,
                          splats_.light[1][entry] * scale_,
                          splats_.light[2][entry] * scale_};
  for (std::size_t r = 0; r < row_.size(); ++r) {
    auto pixel =
        std::uint32_t((y + int(r) - window_.y0) * window_.width() + x - window_.x0);
    for (const float weight : column_) {
      PixelSplat& to = SplatOf(pixel++, first, out);
      for (int c = 0; c < 3; ++c) {
        to.light[c] += light[c] * (weight * row_[r]);
      }
    }
  }
}

}  // namespace lanelight
