// Measures the state file of a film: its size; wall and processor seconds and GB/s to
// copy the film, to compress and write it, to check the file, and to read it. A copy of
// memory is measured beside. Verifies the result first.
//
//   bench_state [--resolution WxH] [--spp N] [--group N] [--threads N] [--repeats N]
//               [--folder .]
//
// The film's sums are those of samples as renders have them: single precision, from a
// lognormal distribution, a tenth of them black.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

#include "src/base/core/clock.h"
#include "src/base/core/error.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/parallel.h"
#include "src/base/state/state_file.h"

namespace lanelight {
namespace {

struct BenchOptions {
  std::string resolution = "1920x1080", folder = ".";
  int spp = 64, group = 16, threads = 0, repeats = 5;
};

// The film sums of a pixel, for three colours: the sum, the open group's sum, the
// squares, and the sum of the means of groups.
struct Sums {
  double value[4][3] = {};
};

struct Film {
  std::vector<Sums> sums;
  std::vector<std::uint64_t> samples;

  explicit Film(std::size_t pixels) : sums(pixels), samples(pixels) {}
  std::vector<MutableStateColumn> Columns() {
    return {MakeStateColumn<double>("sums", "sums of samples", sums, {4, 3}),
            MakeStateColumn<std::uint64_t>("samples", "samples", samples)};
  }
  std::size_t Bytes() const { return samples.size() * (sizeof(Sums) + 8); }
  bool operator==(const Film& other) const {
    return samples == other.samples &&
           std::memcmp(sums.data(), other.sums.data(), sums.size() * sizeof(Sums)) == 0;
  }
};

// A table of samples is enough: each pixel begins somewhere in it.
std::vector<float> Samples() {
  std::vector<float> samples(1 << 16);
  std::uint64_t state = 1;
  const auto uniform = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double(state >> 11) + 0.5) * 0x1p-53;
  };
  for (float& s : samples) {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    const double normal = radius * std::cos(6.283185307179586 * uniform());
    s = uniform() < 0.1 ? 0 : static_cast<float>(std::exp(normal - 1));
  }
  return samples;
}

void Fill(Film& film, const BenchOptions& options) {
  const std::vector<float> table = Samples();
  ParallelFor(film.samples.size(), [&](std::size_t pixel) {
    Sums& s = film.sums[pixel];
    for (int i = 0; i < 3 * options.spp; ++i) {
      const int c = i % 3;
      const double value = table[(pixel * 40503 + std::size_t(i)) % table.size()];
      s.value[0][c] += value;
      s.value[1][c] += value;
      if ((i / 3 + 1) % options.group != 0) continue;
      const double mean = s.value[1][c] / options.group;
      s.value[1][c] = 0;
      s.value[2][c] += mean * mean;
      s.value[3][c] += mean;
    }
    film.samples[pixel] = std::uint64_t(options.spp);
  });
}

double WallSeconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

double Median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Step {
  const char* name;
  std::vector<double> seconds = {}, processor = {};

  template <class Action>
  void Time(const Action& action) {
    const double start = WallSeconds(), cpu = ProcessCpuSeconds();
    action();
    processor.push_back(ProcessCpuSeconds() - cpu);
    seconds.push_back(WallSeconds() - start);
  }
  void Print(double bytes) {
    const double median = Median(seconds);
    fmt::print("{:<10} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.2f}\n", name, median,
               seconds.front(), seconds.back(), Median(processor), bytes / median * 1e-9);
  }
};

void Measure(const BenchOptions& options) {
  PixelRect window;
  if (std::sscanf(options.resolution.c_str(), "%dx%d", &window.x1, &window.y1) != 2) {
    throw InputError("--resolution " + options.resolution + " is not WxH");
  }
  const std::string path = options.folder + "/bench-state.h5";
  Film film(window.pixels()), copy(window.pixels());
  Fill(film, options);
  std::vector<MutableStateColumn> columns = film.Columns();
  const StateContent content = {
      "{}", "{}", window, {window}, {columns.begin(), columns.end()}, {}};
  Step steps[] = {{"memcpy"}, {"copy"}, {"write"}, {"verify"}, {"read"}};
  std::size_t bytes = 0;
  for (int i = 0; i <= options.repeats; ++i) {
    if (i == 1) {
      for (Step& step : steps) step = {step.name};  // the first one warmed up
    }
    steps[0].Time([&] {
      std::memcpy(copy.sums.data(), film.sums.data(), film.sums.size() * sizeof(Sums));
      copy.samples = film.samples;
    });
    std::optional<StateCopy> state;
    steps[1].Time([&] { state.emplace(content); });
    steps[2].Time([&] { state->Write(path); });
    bytes = std::filesystem::file_size(path);
    std::fill(copy.sums.begin(), copy.sums.end(), Sums{});
    std::optional<StateFile> file;
    steps[3].Time([&] { file.emplace(path); });
    steps[4].Time([&] { file->ReadPixels(copy.Columns(), window); });
    if (!(copy == film))
      throw std::runtime_error("what was read is not what was written");
  }
  std::filesystem::remove(path);
  fmt::print("{}, {} samples, {} threads: {:.1f} MB of film, {:.1f} MB of file\n",
             options.resolution, options.spp, MaxThreads(), double(film.Bytes()) * 1e-6,
             double(bytes) * 1e-6);
  fmt::print("{:<10} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "", "median s", "least", "most",
             "cpu s", "GB/s");
  for (Step& step : steps) step.Print(double(film.Bytes()));
}

int Main(int argc, char** argv) {
  BenchOptions o;
  CLI::App app("the state file of a film");
  app.add_option("--resolution", o.resolution, "WxH");
  app.add_option("--spp", o.spp, "samples per pixel")->check(CLI::PositiveNumber);
  app.add_option("--group", o.group, "samples of a group")->check(CLI::PositiveNumber);
  app.add_option("--threads", o.threads, "0: all cores")->check(CLI::NonNegativeNumber);
  app.add_option("--repeats", o.repeats, "repetitions")->check(CLI::PositiveNumber);
  app.add_option("--folder", o.folder, "where the file is written");
  CLI11_PARSE(app, argc, argv);
  const ThreadLimit limit(o.threads);
  fmt::print("{}\n", MachineText(ThisMachine()));
  Measure(o);
  return 0;
}

}  // namespace
}  // namespace lanelight

int main(int argc, char** argv) {
  try {
    return lanelight::Main(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
