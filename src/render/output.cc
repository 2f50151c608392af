#include "src/render/output.h"

#include <limits>

#include "src/core/error.h"
#include "src/core/version.h"

namespace lanelight {
namespace {

// Calls fill(pixel index, x, y) for every pixel of the film, rows from the top.
template <class Fill>
void ForEachPixel(const FilmAccumulator& film, Fill&& fill) {
  std::size_t i = 0;
  for (int y = film.y0(); y < film.y0() + film.height(); ++y) {
    for (int x = film.x0(); x < film.x0() + film.width(); ++x) fill(i++, x, y);
  }
}

std::vector<ExrPlane> NamedPlanes(std::initializer_list<const char*> names,
                                  std::size_t pixels, bool always_float) {
  std::vector<ExrPlane> planes;
  for (const char* name : names) {
    planes.push_back({name, std::vector<float>(pixels), always_float});
  }
  return planes;
}

void AppendAov(const FilmAccumulator& film, double scale, std::size_t pixels,
               std::vector<ExrPlane>& planes) {
  auto aov = NamedPlanes(
      {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"},
      pixels, false);
  aov[kAovPlanes - 1].always_float = true;  // half overflows at 65504 units
  ForEachPixel(film, [&](std::size_t i, int x, int y) {
    for (int p = 0; p < kAovPlanes; ++p) {
      const double unit = p == kAovPlanes - 1 ? scale : 1;
      aov[p].values[i] = static_cast<float>(film.Aov(x, y, p) / unit);
    }
  });
  for (ExrPlane& plane : aov) planes.push_back(std::move(plane));
}

}  // namespace

std::vector<ExrPlane> FilmPlanes(const FilmAccumulator& film, double scale) {
  const std::size_t pixels = static_cast<std::size_t>(film.width()) * film.height();
  auto planes = NamedPlanes({"R", "G", "B"}, pixels, false);
  // Variances of dim pixels are far below the smallest half.
  for (ExrPlane& p :
       NamedPlanes({"variance.R", "variance.G", "variance.B", "samples"}, pixels, true)) {
    planes.push_back(std::move(p));
  }
  ForEachPixel(film, [&](std::size_t i, int x, int y) {
    const Rgb mean = film.Mean(x, y), variance = film.Variance(x, y);
    const bool known = film.HasVariance(x, y);
    for (int c = 0; c < 3; ++c) {
      planes[c].values[i] = static_cast<float>(mean[c]);
      planes[3 + c].values[i] = known ? static_cast<float>(variance[c])
                                      : std::numeric_limits<float>::quiet_NaN();
    }
    planes[6].values[i] = static_cast<float>(film.Samples(x, y));
  });
  if (film.has_aov()) AppendAov(film, scale, pixels, planes);
  return planes;
}

ExrOptions OutputOptions(const Job& job, const RunResult& result, bool half) {
  ExrOptions options;
  options.half = half;
  options.x0 = job.window.x0;
  options.y0 = job.window.y0;
  options.full_width = job.description.film.width;
  options.full_height = job.description.film.height;
  // Samples actually taken per pixel, on average: an interrupted render has fewer.
  const double spp = double(result.samples) / double(job.window.pixels());
  options.attributes["seed"] = std::to_string(job.seed);
  options.attributes["spp"] = spp;
  options.attributes["renderTime"] = result.seconds;
  options.attributes["strategy"] = "path, " + ToText(job.scene.strategy);
  options.attributes["version"] = FullVersion();
  options.attributes["sceneHash"] = fmt::format("{:016x}", job.scene_hash);
  return options;
}

Image FilmImage(const FilmAccumulator& film) {
  Image image = MakeImage(film.width(), film.height(), {"R", "G", "B"});
  ForEachPixel(film, [&](std::size_t i, int x, int y) {
    const Rgb mean = film.Mean(x, y);
    for (int c = 0; c < 3; ++c) image.pixels[3 * i + c] = static_cast<float>(mean[c]);
  });
  return image;
}

}  // namespace lanelight
