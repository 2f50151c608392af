#include "src/render/wave/films.h"

#include "src/base/core/check.h"

namespace lanelight {

Films::Films(const SamplePlanes& planes, double coefficient, FilmAccumulator& film)
    : planes_(planes), film_(film) {
  LL_CHECK_EQ(planes.Has(PlaneGroup::kAov), film.has_aov());
  LL_CHECK_EQ(planes.Has(PlaneGroup::kGbuffer), film.has_gbuffer());
  LL_CHECK_EQ(planes.Has(PlaneGroup::kRadiance), film.buckets() != nullptr);
  if (planes.Has(PlaneGroup::kNumbers)) film_.UseRegression(coefficient);
}

void Films::UseResponse(const FilmResponse& response) {
  if (!response.IsIdentity()) response_ = response;
}

void Films::Respond(const TileSamples& tile) const {
  const std::size_t count = tile.pixels.size() * tile.count;
  float* const first =
      tile.values + std::size_t(planes_.First(PlaneGroup::kColor)) * count;
  const ColorPlanes planes = {first, first + count, first + 2 * count};
  if (response_->limits()) LimitColors(*response_, planes, count);
  ConvertColors(*response_, planes, count);
}

// Strategies with light subpaths refuse a limit, which would apply to whole samples.
void Films::RespondToSplats(std::vector<PixelSplat>& splats) const {
  const std::size_t count = splats.size();
  std::vector<float> values(3 * count);
  float* const first = values.data();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) first[c * count + i] = splats[i].light[c];
  }
  const ColorPlanes planes = {first, first + count, first + 2 * count};
  ConvertColors(*response_, planes, count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) splats[i].light[c] = first[c * count + i];
  }
}

void Films::Add(const TileSamples& tile) {
  if (response_) Respond(tile);
  const std::vector<std::uint32_t>& pixels = tile.pixels;
  const std::size_t stride = pixels.size() * tile.count;
  constexpr int kMaxPlanes = FilmAccumulator::kMaxPlanes;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const float* planes[kMaxPlanes];
    for (int p = 0; p < std::min(planes_.count(), kMaxPlanes); ++p) {
      planes[p] = tile.values + std::size_t(p) * stride + i * tile.count;
    }
    film_.AddSamples(int(pixels[i]) % tile.width, int(pixels[i]) / tile.width, planes,
                     tile.count);
  }
  if (film_.splats() == nullptr) return;
  if (response_) RespondToSplats(*tile.splats);
  film_.splats()->Add(*tile.splats, tile.light_paths);
}

}  // namespace lanelight
