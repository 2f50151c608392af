#include "src/render/job/output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/core/source_location.h"
#include "src/base/image/image.h"
#include "src/base/image/spectrum.h"
#include "src/render/films/accumulator.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {
namespace {

// Calls fill(index of the pixel, x, y) for every pixel of the film.
template <class Fill>
void FillPixels(const FilmAccumulator& film, const Fill& fill) {
  std::size_t i = 0;
  ForEachPixel(film, [&](int x, int y) { fill(i++, x, y); });
}

std::vector<ExrPlane> NamedPlanes(std::initializer_list<const char*> names,
                                  std::size_t pixels, bool always_float) {
  std::vector<ExrPlane> planes;
  for (const char* name : names) {
    planes.push_back({name, std::vector<float>(pixels), always_float});
  }
  return planes;
}

// Uses the names of pbrt-v4's GBufferFilm, and adds the share of samples that hit
// something.
void AppendGbuffer(const FilmAccumulator& film, std::size_t pixels,
                   std::vector<ExrPlane>& planes) {
  auto gbuffer = NamedPlanes({"coverage", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z",
                              "Ns.X", "Ns.Y", "Ns.Z", "u", "v", "dzdx", "dzdy"},
                             pixels, true);
  FillPixels(film, [&](std::size_t i, int x, int y) {
    for (int p = 0; p < kGbufferPlanes; ++p) {
      gbuffer[p].values[i] = float(film.Gbuffer(x, y, p));
    }
  });
  for (ExrPlane& plane : gbuffer) planes.push_back(std::move(plane));
}

void AppendAov(const FilmAccumulator& film, double scale, std::size_t pixels,
               std::vector<ExrPlane>& planes) {
  auto aov = NamedPlanes(
      {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"},
      pixels, false);
  aov[kAovPlanes - 1].always_float = true;  // half overflows at 65504 units
  FillPixels(film, [&](std::size_t i, int x, int y) {
    for (int p = 0; p < kAovPlanes; ++p) {
      const double unit = p == kAovPlanes - 1 ? scale : 1;
      aov[p].values[i] = float(film.Aov(x, y, p) / unit);
    }
  });
  for (ExrPlane& plane : aov) planes.push_back(std::move(plane));
}

void AppendBuckets(const FilmAccumulator& film, std::size_t pixels,
                   std::vector<ExrPlane>& planes) {
  for (int b = 0; b < film.buckets()->count; ++b) {
    ExrPlane plane = {ChannelName(*film.buckets(), b), std::vector<float>(pixels)};
    FillPixels(film, [&](std::size_t i, int x, int y) {
      plane.values[i] = float(film.Bucket(x, y, b));
    });
    planes.push_back(std::move(plane));
  }
}

}  // namespace

int VarianceExponent(const FilmAccumulator& film) {
  double largest = 0;
  FillPixels(film, [&](std::size_t, int x, int y) {
    if (!film.HasVariance(x, y)) return;
    const Rgb variance = film.Variance(x, y);
    for (int c = 0; c < 3; ++c) {
      if (std::isfinite(variance[c])) largest = std::max(largest, variance[c]);
    }
  });
  return VarianceExponent(largest);
}

std::vector<ExrPlane> FilmPlanes(const FilmAccumulator& film, double scale) {
  const std::size_t pixels = std::size_t(film.width()) * film.height();
  auto planes = NamedPlanes({"R", "G", "B"}, pixels, false);
  // Variances of dim pixels are far below the smallest half.
  for (ExrPlane& p :
       NamedPlanes({"variance.R", "variance.G", "variance.B", "samples"}, pixels, true)) {
    planes.push_back(std::move(p));
  }
  const double unit = std::ldexp(1.0, -VarianceExponent(film));
  FillPixels(film, [&](std::size_t i, int x, int y) {
    const Rgb mean = film.Mean(x, y), variance = film.Variance(x, y) * unit;
    const bool known = film.HasVariance(x, y);
    for (int c = 0; c < 3; ++c) {
      planes[c].values[i] = float(mean[c]);
      planes[3 + c].values[i] =
          known ? float(variance[c]) : std::numeric_limits<float>::quiet_NaN();
    }
    planes[6].values[i] = float(film.Samples(x, y));
  });
  if (film.has_aov()) AppendAov(film, scale, pixels, planes);
  if (film.has_gbuffer()) AppendGbuffer(film, pixels, planes);
  if (film.buckets() != nullptr) AppendBuckets(film, pixels, planes);
  return planes;
}

void NoteVarianceUnit(const FilmAccumulator& film, ExrOptions& options) {
  const int exponent = VarianceExponent(film);
  if (exponent != 0) options.attributes[kVarianceExponent] = exponent;
}

namespace {

// Stores the estimated error, or why it has no upper end.
void NoteError(const ErrorEstimate& error, ExrOptions& options) {
  if (!error.available) return;
  options.attributes["relmse"] = error.relmse.value;
  options.attributes["relmseLow"] = error.relmse.low;
  if (error.relmse.HasBounds()) {
    options.attributes["relmseHigh"] = error.relmse.high;
  } else {
    options.attributes["relmseDoubt"] = error.why;
  }
}

// Stores the smallest number of observations of a pixel, on which variances rest.
void NoteObservations(const FilmAccumulator& film, ExrOptions& options) {
  constexpr std::uint64_t kMaxObservations = 1 << 30;
  std::uint64_t min_observations = kMaxObservations;
  FillPixels(film, [&](std::size_t, int x, int y) {
    if (film.HasVariance(x, y))
      min_observations = std::min(min_observations, film.Observations(x, y));
  });
  if (min_observations < kMaxObservations)
    options.attributes[kObservations] = int(min_observations);
  const std::uint64_t pixels = std::uint64_t(film.width()) * std::uint64_t(film.height());
  const std::uint64_t empty = pixels - SampledPixels(film);
  if (empty > 0) options.attributes[kEmptyPixels] = int(empty);
  if (film.groups().dependents > 1) {
    options.attributes[kDependentPixels] = film.groups().dependents;
  }
}

// Returns the strategy of an identity with the changes by its trial run.
std::string ChangedStrategy(const std::string& own, const std::string& changes) {
  Strategy strategy;
  ApplyStrategy(own, {}, strategy);
  ApplyStrategy(changes, {}, strategy);
  return ToText(strategy);
}

}  // namespace

ExrOptions OutputOptions(const nlohmann::json& identity, const nlohmann::json& head,
                         const OutputRun& run, const FilmAccumulator& film, bool half) {
  const std::array<int, 4> crop = identity.at("crop");
  const std::array<int, 2> resolution = identity.at("resolution");
  ExrOptions options;
  options.half = half;
  options.color_space = identity.value("color_space", std::string("srgb"));
  options.x0 = crop[0];
  options.y0 = crop[1];
  options.full_width = resolution[0];
  options.full_height = resolution[1];
  // Samples actually taken per pixel, on average: an interrupted render has fewer.
  const double pixels = double(crop[2] - crop[0]) * double(crop[3] - crop[1]);
  const nlohmann::json& seed = identity.at("seed");
  options.attributes["seed"] = DumpJson(seed);
  options.attributes["spp"] = double(run.counts.samples) / pixels;
  options.attributes["renderTime"] = run.counts.seconds;
  options.attributes["strategy"] =
      "path, " + ChangedStrategy(identity.at("strategy"), run.changes);
  options.attributes["version"] = identity.at("version").get<std::string>();
  options.attributes["sceneHash"] = identity.at("scene_hash").get<std::string>();
  nlohmann::json settings = identity;
  for (const char* apart : {"seed", "strategy", "version", "scene_hash"}) {
    settings.erase(apart);
  }
  options.attributes["settings"] = DumpJson(settings);
  const nlohmann::json machine = head.value("machine", nlohmann::json());
  if (!machine.is_null()) options.attributes["machine"] = machine.value("text", "");
  if (film.buckets() != nullptr) {
    // The same attributes as in pbrt-v4.
    options.attributes["spectralLayoutVersion"] = "1.0";
    options.attributes["emissiveUnits"] = "W.m^-2.sr^-1";
  }
  NoteError(run.error, options);
  NoteObservations(film, options);
  NoteVarianceUnit(film, options);
  return options;
}

Image FilmImage(const FilmAccumulator& film, const std::string& color_space) {
  Image image = MakeImage(film.width(), film.height(), {"R", "G", "B"});
  FillPixels(film, [&](std::size_t i, int x, int y) {
    const Rgb mean = ToSrgb(color_space, film.Mean(x, y), SpectrumUse::kUnbounded);
    for (int c = 0; c < 3; ++c) image.pixels[3 * i + c] = float(mean[c]);
  });
  return image;
}

}  // namespace lanelight
