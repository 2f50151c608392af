#include "src/measure/sweep/probe_render.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "src/render/estimate/estimate.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/output.h"
#include "src/render/job/saving.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Windows of at most 32 x 32 pixels in a grid of 8 x 8 over the image.
std::vector<PixelRect> SpreadWindows(const PixelRect& image) {
  constexpr int kSide = 32, kGrid = 8;
  const int width = std::min(kSide, std::max(1, image.width() / kGrid));
  const int height = std::min(kSide, std::max(1, image.height() / kGrid));
  const int columns = std::min(kGrid, image.width() / width);
  const int rows = std::min(kGrid, image.height() / height);
  std::vector<PixelRect> windows;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int x =
          image.x0 + (image.width() - width) * column / std::max(1, columns - 1);
      const int y = image.y0 + (image.height() - height) * row / std::max(1, rows - 1);
      windows.push_back({x, y, x + width, y + height});
    }
  }
  return windows;
}

// The size of the file that an image like this makes.
double FileBytes(const FilmAccumulator& film, const Job& job, bool half) {
  const std::string path = FallbackPath("pilot.exr");
  ExrOptions options;
  options.half = half;
  WriteExr(path, film.width(), film.height(), FilmPlanes(film, job.scene.scale()),
           options);
  const double bytes = double(fs::file_size(path));
  std::error_code ignored;
  fs::remove(path, ignored);
  return bytes;
}

}  // namespace

ProbeRender RenderProbe(const Job& job, double seconds, bool half) {
  const std::vector<PixelRect> windows = SpreadWindows(job.window);
  const int width = windows.front().width() * static_cast<int>(windows.size());
  const int height = windows.front().height();
  ProbeRender probe;
  probe.pixels = double(job.window.pixels());
  probe.spp = static_cast<std::uint64_t>(job.loaded->description.sampler.spp);
  probe.load_seconds = job.loaded->load_seconds;
  probe.build_seconds = job.loaded->build_seconds;
  RunOptions options;
  options.windows = windows;
  options.seed = job.seed;
  options.threads = job.settings.threads;
  // The first render fills caches; the last one measures.
  Job windowed = job;
  windowed.window = {0, 0, width, height};
  for (options.spp = kProbeSamples;; options.spp *= 4) {
    FilmAccumulator film = MakeFilm(windowed);
    const RunResult result = Run(job.scene, job.plan, options, film);
    probe.sample_seconds =
        result.seconds / double(std::max<std::uint64_t>(1, result.samples));
    if (4 * result.seconds < seconds && options.spp < 1024) continue;
    const ErrorEstimate error = EstimateError(film);
    if (error.available) {
      probe.relmse = error.relmse.value * double(options.spp);
      probe.mse = error.rmse.value * error.rmse.value * double(options.spp);
    }
    probe.bytes_per_pixel =
        FileBytes(film, job, half) / double(film.width()) / film.height();
    return probe;
  }
}

}  // namespace lanelight
