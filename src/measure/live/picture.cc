#include "src/measure/live/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/base/core/suggest.h"
#include "src/base/image/color_spaces.h"
#include "src/base/image/spectrum.h"
#include "src/measure/report/page.h"
#include "src/render/films/accumulator.h"

namespace lanelight::live {
namespace {

struct LayerInfo {
  const char *name, *meaning;
};
constexpr LayerInfo kLayers[] = {
#define X(enumerator, name, meaning) {name, meaning},
    LANELIGHT_LIVE_LAYERS(X)
#undef X
};

double MeanOf(Rgb c) { return (c[0] + c[1] + c[2]) / 3; }

float LayerAt(const PassRenderer& renderer, Layer layer, int x, int y) {
  const FilmAccumulator& film = renderer.film();
  switch (layer) {
    case Layer::kNone:
      return 0;
    case Layer::kRays:
      return static_cast<float>(renderer.cost().RaysPerSample(x, y));
    case Layer::kSegments:
      return static_cast<float>(renderer.cost().SegmentsPerSample(x, y));
    case Layer::kError:
    case Layer::kRelative:
      break;
  }
  if (!film.HasVariance(x, y)) return NAN;
  const double variance = MeanOf(film.Variance(x, y));
  if (layer == Layer::kError) return static_cast<float>(std::sqrt(variance));
  const Rgb mean = film.Mean(x, y);
  return static_cast<float>(
      std::sqrt(variance / (MeanOf(mean * mean) + kRelativeEpsilon)));
}

std::vector<PixelRect> Squares(const PixelRect& window) {
  std::vector<PixelRect> squares;
  for (int y = window.y0; y < window.y1; y += kSquare) {
    for (int x = window.x0; x < window.x1; x += kSquare) {
      squares.push_back(
          {x, y, std::min(window.x1, x + kSquare), std::min(window.y1, y + kSquare)});
    }
  }
  return squares;
}

std::uint64_t SamplesOf(const FilmAccumulator& film, const PixelRect& square) {
  std::uint64_t sum = 0;
  ForEachPixel(square, [&](int x, int y) { sum += film.Samples(x, y); });
  return sum;
}

// Returns the conversion to sRGB that the PNG of a render uses (FilmImage).
ColorMatrix SrgbOf(const std::string& space) {
  const auto column = [&](Rgb primary) {
    return ToSrgb(space, primary, SpectrumUse::kUnbounded);
  };
  const Rgb r = column({1, 0, 0}), g = column({0, 1, 0}), b = column({0, 0, 1});
  return {{{r.x, g.x, b.x}, {r.y, g.y, b.y}, {r.z, g.z, b.z}}};
}

void PutHalf(char*& at, double value) {
  const std::uint16_t bits = ToHalfBits(static_cast<float>(value));
  *at++ = static_cast<char>(bits & 255);
  *at++ = static_cast<char>(bits >> 8);
}

void PutSquare(const PassRenderer& renderer, Layer layer, const PixelRect& square,
               const ColorMatrix& srgb, char* at) {
  const FilmAccumulator& film = renderer.film();
  ForEachPixel(square, [&](int x, int y) {
    const Rgb color = srgb * film.Mean(x, y);
    for (int c = 0; c < 3; ++c) PutHalf(at, color[c]);
    PutHalf(at, double(film.Samples(x, y)));
  });
  if (layer == Layer::kNone) return;
  ForEachPixel(square,
               [&](int x, int y) { PutHalf(at, LayerAt(renderer, layer, x, y)); });
}

// Returns the squares that have changed, and marks them as sent.
std::vector<PixelRect> Changed(const FilmAccumulator& film, SentPicture& sent) {
  const std::vector<PixelRect> all = Squares(WindowOf(film));
  sent.samples.resize(all.size());
  std::vector<std::uint64_t> now(all.size());
  ParallelFor(all.size(), [&](std::size_t i) { now[i] = SamplesOf(film, all[i]); });
  std::vector<PixelRect> changed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (now[i] != sent.samples[i]) changed.push_back(all[i]);
  }
  sent.samples = std::move(now);
  return changed;
}

}  // namespace

std::string BinaryHead(const nlohmann::json& head) {
  std::string text = DumpJson(head);
  text.append((8 - (text.size() + 4) % 8) % 8, ' ');
  const auto n = static_cast<std::uint32_t>(text.size());
  std::string out;
  for (int byte = 0; byte < 4; ++byte) out += static_cast<char>(n >> (8 * byte) & 255);
  return out + text;
}

Layer LayerNamed(const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::size(kLayers); ++i) {
    if (name == kLayers[i].name) return static_cast<Layer>(i);
    names.push_back(kLayers[i].name);
  }
  ThrowUnknown({}, "layer", name, names);
}

nlohmann::json LayersJson() {
  nlohmann::json layers = nlohmann::json::array();
  for (const LayerInfo& layer : kLayers) {
    layers.push_back({{"name", layer.name}, {"meaning", layer.meaning}});
  }
  return layers;
}

std::string EncodePicture(const PassRenderer& renderer, nlohmann::json head,
                          SentPicture& sent) {
  const FilmAccumulator& film = renderer.film();
  const std::vector<PixelRect> changed = Changed(film, sent);
  if (changed.empty()) return "";
  const Layer layer = sent.layer;
  nlohmann::json squares = nlohmann::json::array();
  std::vector<std::size_t> begin = {0};
  for (const PixelRect& s : changed) {
    squares.push_back({s.x0 - film.x0(), s.y0 - film.y0(), s.width(), s.height()});
    begin.push_back(begin.back() + s.pixels() * (layer == Layer::kNone ? 8 : 10));
  }
  head["squares"] = std::move(squares);
  head["width"] = film.width();
  head["height"] = film.height();
  head["layer"] = kLayers[static_cast<int>(layer)].name;
  std::string message = BinaryHead(head);
  const std::size_t pixels = message.size();
  message.resize(pixels + begin.back());
  const ColorMatrix srgb = SrgbOf(renderer.view().film.color_space);
  ParallelFor(changed.size(), [&](std::size_t i) {
    PutSquare(renderer, layer, changed[i], srgb, message.data() + pixels + begin[i]);
  });
  return message;
}

nlohmann::json PixelJson(const PassRenderer& renderer, int x, int y) {
  const FilmAccumulator& film = renderer.film();
  const PixelRect window = WindowOf(film);
  if (x < window.x0 || x >= window.x1 || y < window.y0 || y >= window.y1) return nullptr;
  const Rgb mean = film.Mean(x, y);
  nlohmann::json error = nullptr;
  if (film.HasVariance(x, y)) {
    const Rgb variance = film.Variance(x, y);
    error = {std::sqrt(variance[0]), std::sqrt(variance[1]), std::sqrt(variance[2])};
  }
  return {{"value", {mean[0], mean[1], mean[2]}},
          {"error", error},
          {"samples", film.Samples(x, y)}};
}

}  // namespace lanelight::live
