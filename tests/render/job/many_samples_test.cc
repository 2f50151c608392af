// Renders with very many samples per pixel: all are taken and count, and memory does not
// grow with them.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "src/base/core/parallel.h"
#include "src/render/job/job.h"

namespace lanelight {
namespace {

constexpr int kSide = 2;

// Bytes; 0 where Linux does not say.
std::size_t PeakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib << 10;
  }
  return 0;
}

// The peak is of what follows, not of tests that ran before.
void ForgetPeak() { std::ofstream("/proc/self/clear_refs") << "5"; }

struct Render {
  Rgb mean, error;  // of one pixel
  std::size_t peak = 0, buffers = 0;
};

Render RenderCrop(std::uint64_t spp, const std::string& sampler) {
  RenderSettings settings;
  settings.spp = spp;
  settings.crop = {150, 150, 150 + kSide, 150 + kSide};
  settings.resolution = {400, 400};
  if (sampler == "independent") settings.sampler = SampleSequence::kIndependent;
  const Job job = PrepareJob(LANELIGHT_SOURCE_DIR "/scenes/cornell-box.pbrt", settings);
  FilmAccumulator film = MakeFilm(job);
  // A second thread may come to work, and need memory, in one render and not in another.
  const ThreadLimit limit(1);
  ForgetPeak();
  const RunResult result = Run(job.scene, job.plan, RunOptionsOf(job), film);
  Render out;
  out.peak = PeakMemory();
  out.buffers = result.wavefront_bytes;
  CHECK(result.stop_reason == StopReason::kSamples);
  CHECK(result.samples == spp * kSide * kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) CHECK(film.Samples(150 + x, 150 + y) == spp);
  }
  out.mean = film.Mean(150, 150);
  const Rgb variance = film.Variance(150, 150);
  for (int c = 0; c < 3; ++c) out.error[c] = std::sqrt(variance[c]);
  return out;
}

void CheckFlat(std::uint64_t few, std::uint64_t many, const std::string& sampler) {
  CAPTURE(few, many, sampler);
  RenderCrop(few, sampler);  // what is allocated once, and kept
  const Render first = RenderCrop(few, sampler), second = RenderCrop(many, sampler);
  REQUIRE(first.peak > 0);
  CHECK(second.peak < first.peak + (std::size_t{2} << 20));
  CHECK(second.buffers == first.buffers);
  // More samples of the same: errors fall, means agree.
  const double gain = std::sqrt(double(many) / double(few));
  for (int c = 0; c < 3; ++c) {
    CHECK(second.mean[c] > 0);
    CHECK(std::abs(first.mean[c] - second.mean[c]) <
          6 * std::hypot(first.error[c], second.error[c]));
    if (sampler == "independent") {
      CHECK(second.error[c] == Approx(first.error[c] / gain).epsilon(0.1));
    }
  }
}

}  // namespace

TEST_CASE("many samples: memory is flat", "[render]") {
  CheckFlat(20'000, 200'000, "independent");
}

TEST_CASE("many samples: ten million per pixel, memory is flat", "[render][slow]") {
  CheckFlat(100'000, 10'000'000, "independent");
  CheckFlat(100'000, 10'000'000, "sobol");
}

}  // namespace lanelight
