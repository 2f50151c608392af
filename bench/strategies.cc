// Strategies side by side: variance, time and efficiency 1 / (variance x seconds)
// relative to a baseline, with 95 % bootstrap intervals; samples/s, lanes filled, bytes
// per path.
//
//   bench_strategies SCENE... [--spp N] [--repeats R] [--resolution WxH] [--threads T]
//                    [--strategies 'A;B;...'] [--markdown]
//
// All strategies of a scene are rendered in turn (A B C A B C ...), each repetition with
// another seed. The variance is that between the repetitions, so it includes what a
// render's own estimate may miss; where rare samples carry much of it, it takes many
// repetitions. Seconds are processor seconds. A row whose mean image differs is marked.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>

#include "bench/efficiency.h"
#include "src/core/error.h"
#include "src/core/parallel.h"
#include "src/render/job.h"

namespace lanelight {
namespace {

constexpr const char* kBaseline =
    "directions=bsdf,points=independent,roulette=throughput";

// One row per choice; beyond directions, each changes one thing of the row `mis`.
const std::vector<std::string>& DefaultStrategies() {
  static const std::vector<std::string> kRows = [] {
    std::vector<std::string> rows = {kBaseline};
    const auto with = [](const std::string& change) {
      return std::string("directions=mis,points=independent,roulette=throughput") +
             (change.empty() ? "" : ",") + change;
    };
    rows.push_back("directions=uniform,points=independent,roulette=throughput");
    rows.push_back("directions=light,points=independent,roulette=throughput");
    rows.push_back(with(""));
    rows.push_back(with("directions=mis:balance"));
    for (const char* points :
         {"stratified", "cmj", "pmj02", "sobol", "halton", "lattice"}) {
      rows.push_back(with(std::string("points=") + points));
    }
    for (const char* paired : {"all", "pixel", "light", "bsdf", "first-bounce"}) {
      rows.push_back(with(std::string("pairs=antithetic:") + paired));
    }
    rows.push_back(with("control=analytic,c=1"));
    rows.push_back(with("control=analytic"));
    rows.push_back(with("control=ambient"));
    rows.push_back(with("control=regression"));
    for (const char* roulette :
         {"none", "constant:0.25", "luminance", "adjoint", "efficiency"}) {
      rows.push_back(with(std::string("roulette=") + roulette));
    }
    rows.push_back(with("light-selection=uniform"));
    rows.push_back(with("light-selection=tree"));
    return rows;
  }();
  return kRows;
}

struct BenchOptions {
  std::vector<std::string> scenes;
  std::string strategies, resolution = "96x96";
  std::uint64_t spp = 64;
  int repeats = 8, threads = 1;
  bool markdown = false;
};

std::vector<std::string> SplitList(const std::string& text) {
  std::vector<std::string> items;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    if (end > begin) items.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return items;
}

std::vector<Rgb> Pixels(const FilmAccumulator& film) {
  std::vector<Rgb> pixels;
  for (int y = film.y0(); y < film.y0() + film.height(); ++y) {
    for (int x = film.x0(); x < film.x0() + film.width(); ++x) {
      pixels.push_back(film.Mean(x, y));
    }
  }
  return pixels;
}

// Of the whole process: unlike the wall clock it does not count other programs.
double CpuSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

double Occupancy(const RunResult& result) {
  double items = 0, lanes = 0;
  for (const StageProfile& s : result.stages) {
    items += double(s.items);
    lanes += double(s.lane_slots);
  }
  return lanes > 0 ? items / lanes : 0;
}

// Switches the job to another strategy without compiling the scene again.
void SetStrategy(Job& job, const std::string& text) {
  Strategy strategy;
  ApplyStrategy(text, {std::make_shared<const std::string>("--strategies"), 0, 0},
                strategy);
  SetStrategy(job, strategy);
}

void RenderOnce(Job& job, std::uint64_t seed, Repetitions& r) {
  try {
    SetStrategy(job, r.strategy);
  } catch (const InputError& error) {
    r.refused = error.what();
    return;
  }
  job.seed = seed;
  FilmAccumulator film = MakeFilm(job);
  const double start = CpuSeconds();
  const RunResult result = RunJob(job, film);
  r.seconds.push_back(CpuSeconds() - start);
  r.images.push_back(Pixels(film));
  r.bytes_per_path = job.plan.bytes_per_path;
  r.occupancy = Occupancy(result);
  r.invalid += result.health.Total();
}

std::vector<Repetitions> Measure(const std::string& path, const BenchOptions& options) {
  RenderSettings settings;
  settings.spp = options.spp;
  int width = 0, height = 0;
  if (std::sscanf(options.resolution.c_str(), "%dx%d", &width, &height) != 2) {
    throw InputError("--resolution " + options.resolution + " is not WxH");
  }
  settings.resolution = {width, height};
  Job job = PrepareJob(path, settings);
  std::vector<Repetitions> all;
  const auto rows =
      options.strategies.empty() ? DefaultStrategies() : SplitList(options.strategies);
  for (const std::string& row : rows) {
    all.emplace_back();
    all.back().strategy = row;
  }
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    for (Repetitions& r : all) {
      if (r.refused.empty()) RenderOnce(job, 1 + static_cast<std::uint64_t>(repeat), r);
    }
  }
  return all;
}

void PrintRow(const Repetitions& r, const Comparison& c, const BenchOptions& options,
              double samples) {
  const auto text = [](const Estimate& e) {
    return fmt::format("{:.3g} [{:.3g}, {:.3g}]", e.value, e.low, e.high);
  };
  const char* row =
      options.markdown
          ? "| {} | {} | {} | {} | {} | {} | {:.2f} | {:.1f} % | {} | {} |\n"
          : "{:<66} {:>20} {:>20} {:>18} {:>20} {:>20} {:>5.2f} {:>5.1f} % {:>4} {}\n";
  fmt::print(fmt::runtime(row), r.strategy, text(c.variance), text(c.trimmed_variance),
             text(c.seconds), text(c.efficiency), text(c.trimmed_efficiency),
             1e-6 * samples / Median(r.seconds), 100 * r.occupancy, r.bytes_per_path,
             r.invalid > 0          ? fmt::format("{} INVALID SAMPLES", r.invalid)
             : c.same_mean_p < 1e-5 ? "DIFFERENT MEAN"
                                    : "");
}

bool PrintScene(const std::string& path, const std::vector<Repetitions>& all,
                const BenchOptions& options) {
  const std::vector<double> scales = PixelScales(all);
  const double samples = double(options.spp) * double(scales.size());
  bool good = true;
  fmt::print("\n{}: {} spp, {} repetitions, {} thread(s); relative to the first row\n",
             path, options.spp, options.repeats, options.threads);
  fmt::print("\"trimmed\": without the worst {} % of the pixels of each render\n\n",
             100 * kTrimmed);
  if (options.markdown) {
    fmt::print(
        "| strategy | variance | trimmed variance | time | efficiency | trimmed "
        "efficiency | Ms/s | lanes | bytes/path | |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n");
  } else {
    fmt::print("{:<66} {:>20} {:>20} {:>18} {:>20} {:>20} {:>5} {:>7} {:>4}\n",
               "strategy", "variance", "trimmed variance", "time", "efficiency",
               "trimmed efficiency", "Ms/s", "lanes", "B");
  }
  for (const Repetitions& r : all) {
    if (!r.refused.empty()) {
      fmt::print("{}{:<72} {}\n", options.markdown ? "| " : "", r.strategy, r.refused);
      continue;
    }
    const Comparison c = Compare(r, all.front(), scales);
    good &= c.same_mean_p >= 1e-5 && r.invalid == 0;
    PrintRow(r, c, options, samples);
  }
  std::fflush(stdout);
  return good;
}

int Main(int argc, char** argv) {
  BenchOptions options;
  CLI::App app("Variance, time and efficiency of sampling strategies");
  app.add_option("SCENES", options.scenes, "pbrt scenes")->required();
  app.add_option("--spp", options.spp, "Samples per pixel")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--repeats", options.repeats, "Renders of each, of different seeds")
      ->check(CLI::Range(2, 1000));
  app.add_option("--threads", options.threads, "Threads")->check(CLI::Range(1, 1024));
  app.add_option("--resolution", options.resolution, "Size of the images, WxH");
  app.add_option("--strategies", options.strategies,
                 "List 'A;B;...', the first is the baseline; default: all");
  app.add_flag("--markdown", options.markdown, "Print tables in Markdown");
  CLI11_PARSE(app, argc, argv);
  const ThreadLimit threads(options.threads);
  bool good = true;
  for (const std::string& scene : options.scenes) {
    good &= PrintScene(scene, Measure(scene, options), options);
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace lanelight

int main(int argc, char** argv) {
  try {
    return lanelight::Main(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
