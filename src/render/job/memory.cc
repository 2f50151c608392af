#include "src/render/job/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <string>

#include "src/base/core/error.h"
#include "src/base/core/machine_info.h"
#include "src/render/films/accumulator.h"
#include "src/render/films/regression_film.h"
#include "src/render/train/training.h"
#include "src/scene/description/film.h"
#include "src/scene/prepare/parameters.h"

namespace lanelight {
namespace {

// The output holds R, G, B, three variances and the count.
constexpr std::uint64_t kPlanesPerPixel = (2 * kColorPlanes + 1) * sizeof(float);

std::uint64_t LayersPerPixel(const FilmLayers& layers) {
  const int aov = layers.auxiliary >= Auxiliary::kAov ? kAovPlanes : 0;
  const int gbuffer = layers.auxiliary >= Auxiliary::kGbuffer ? kGbufferPlanes : 0;
  return std::uint64_t(aov + gbuffer + layers.buckets) * sizeof(float);
}

// Sums from which the coefficients of control variates are fitted.
std::uint64_t ControlPerPixel(const Strategy& strategy) {
  if (strategy.control == Control::kNone) return 0;
  return RegressionFilm::BytesPerPixel(GroupsOf(strategy));
}

// A trial run may choose light subpaths.
std::uint64_t SplatsPerPixel(const Strategy& strategy, std::uint64_t pixels) {
  const bool tried = strategy.decide == Decide::kPilot && pixels <= kMaxTrialSplatPixels;
  const bool used = tried || strategy.light_paths != LightPaths::kNone;
  return used ? SplatFilm::BytesPerPixel() : 0;
}

constexpr double kGiB = 1 << 30;

// Returns the limit of `ulimit -v`.
std::uint64_t AddressSpace() {
  rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return ~std::uint64_t{0};
  }
  return limit.rlim_cur;
}

}  // namespace

FilmLayers LayersOf(const RenderSettings& settings, const Film& film) {
  return {AuxiliaryOf(settings, film), film.buckets.count};
}

std::uint64_t FilmBytes(const PixelRect& window, const FilmLayers& layers,
                        const Strategy& strategy) {
  // The planes exist twice for a moment: as planes, and packed into the file's bytes.
  const std::uint64_t per_pixel =
      FilmAccumulator::BytesPerPixel(GroupsOf(strategy), layers.auxiliary) +
      BucketFilm::BytesPerPixel({layers.buckets}) + 2 * kPlanesPerPixel +
      2 * LayersPerPixel(layers) + ControlPerPixel(strategy) +
      SplatsPerPixel(strategy, window.pixels());
  return window.pixels() * per_pixel;
}

std::uint64_t PhysicalMemory() {
  return std::min(ThisMachine().memory_bytes.value_or(~std::uint64_t{0}), AddressSpace());
}

std::string OutOfMemoryText() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const double used = 1024.0 * double(usage.ru_maxrss) / kGiB;
  const std::uint64_t limit = AddressSpace();
  std::string text =
      fmt::format("out of memory: the program had allocated {:.2f} GiB of {:.2f} GiB",
                  used, double(PhysicalMemory()) / kGiB);
  if (limit != ~std::uint64_t{0}) {
    text += fmt::format(", and may address {:.2f} GiB (ulimit -v)", double(limit) / kGiB);
  }
  return text + "; a lower --resolution, a --crop or fewer --threads need less";
}

void CheckFilmFits(const PixelRect& window, const FilmLayers& layers,
                   const Strategy& strategy, std::uint64_t memory) {
  const std::uint64_t need = FilmBytes(window, layers, strategy);
  if (need <= memory) return;
  const bool buckets = layers.buckets > 0;
  throw InputError(fmt::format(
      "an image of {}x{} pixels{} needs {:.1f} GiB of memory, this machine has {:.1f} "
      "GiB; lower --resolution{} or render parts with --crop",
      window.width(), window.height(),
      buckets ? fmt::format(" with {} buckets of wavelengths", layers.buckets) : "",
      need / kGiB, memory / kGiB, buckets ? " or \"nbuckets\"" : ""));
}

}  // namespace lanelight
