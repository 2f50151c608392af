#include "src/measure/throughput/throughput.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/simd/target.h"
#include "src/base/core/check.h"
#include "src/base/core/hash.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/render/job/job.h"
#include "src/scene/parse/parse.h"

namespace lanelight {
namespace {

// Returns null for a scene file.
const BenchScene* FindBenchScene(const std::string& scene) {
  const auto& known = BenchScenes();
  const auto found =
      std::ranges::find_if(known, [&](const BenchScene& s) { return scene == s.name; });
  return found == known.end() ? nullptr : &*found;
}

// Relative difference of means between SIMD targets, which round differently.
constexpr double kSameImage = 5e-3;

double MeanOf(const FilmAccumulator& film) {
  double sum = 0;
  for (int y = film.y0(); y < film.y0() + film.height(); ++y) {
    for (int x = film.x0(); x < film.x0() + film.width(); ++x) {
      const Rgb c = film.Mean(x, y);
      sum += c.x + c.y + c.z;
    }
  }
  return sum / (3.0 * film.width() * film.height());
}

std::uint64_t HashOf(const std::string& scene) {
  const BenchScene* const found = FindBenchScene(scene);
  return found == nullptr ? HashSceneFiles(scene) : Hash64(found->text);
}

// Renders the job once and returns the mean of its image.
double Render(Job job, ThroughputRow& row, const std::atomic<bool>& stop) {
  job.spp = row.spp;
  job.settings.threads = row.threads;
  JobRun run = RunJob(job, {}, &stop);
  row.counts = std::move(run.result);
  return MeanOf(run.film);
}

class SceneBench {
 public:
  SceneBench(const ThroughputOptions& options, const std::string& scene)
      : options_(options), scene_(scene), scene_hash_(HashOf(scene)) {
    RenderSettings settings = options.settings;
    if (!settings.spp) settings.spp = BenchSpp(scene);
    for (const std::string& target : options.targets) {
      settings.target = target;
      jobs_.push_back(PrepareJob(ReadBenchScene(scene), settings));
    }
    for (const Job& job : jobs_) {
      for (const int threads : options.threads) rows_.push_back(RowOf(job, threads));
    }
  }

  // Fills caches and checks images.
  void Begin(const std::atomic<bool>& stop) {
    double first = 0;
    for (std::size_t i = 0; i < rows_.size() && !stop; ++i) {
      const double mean = Render(JobOf(i), rows_[i], stop);
      if (stop) return;
      if (i == 0) first = mean;
      LL_CHECK(std::abs(mean - first) <= kSameImage * std::abs(first) + 1e-9);
    }
  }

  void Repeat(const std::atomic<bool>& stop) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      ThroughputRow& row = rows_[i];
      const double delay = RunDelaySeconds();
      Render(JobOf(i), row, stop);
      if (stop) return;
      row.seconds.push_back(row.counts.seconds);
      row.cpu_seconds.push_back(row.counts.cpu_seconds);
      row.waiting_seconds +=
          std::max({0.0, row.counts.waiting_seconds, RunDelaySeconds() - delay});
    }
  }

  std::vector<ThroughputRow>& rows() { return rows_; }

 private:
  const Job& JobOf(std::size_t row) const { return jobs_[row / options_.threads.size()]; }
  ThroughputRow RowOf(const Job& job, int threads) const {
    ThroughputRow row;
    row.scene = scene_;
    row.scene_hash = scene_hash_;
    row.target = job.plan.options.target.name();
    row.strategy = ToText(job.scene.strategy);
    row.threads = threads;
    row.width = job.window.width();
    row.height = job.window.height();
    row.spp = job.spp;
    row.bytes_per_path = job.plan.bytes_per_path;
    row.wavefront = job.plan.wavefront;
    return row;
  }

  const ThroughputOptions& options_;
  const std::string scene_;
  const std::uint64_t scene_hash_;
  std::vector<Job> jobs_;  // one for each target, with its own BVHs
  std::vector<ThroughputRow> rows_;
};

}  // namespace

std::uint64_t BenchSpp(const std::string& scene) {
  const BenchScene* const found = FindBenchScene(scene);
  return found == nullptr ? kFileSpp : found->spp;
}

SceneDescription ReadBenchScene(const std::string& scene) {
  const BenchScene* const found = FindBenchScene(scene);
  if (found == nullptr) return ParseScene(scene, {});
  return ParseSceneText(found->text, scene + ".pbrt", ".");
}

std::vector<ThroughputRow> MeasureThroughput(
    const ThroughputOptions& options, const std::atomic<bool>& stop,
    const std::function<bool(const BenchProgress&)>& on_scene) {
  std::vector<ThroughputRow> rows;
  const Stopwatch all;
  for (std::size_t i = 0; i < options.scenes.size() && !stop; ++i) {
    SceneBench bench(options, options.scenes[i]);
    const Stopwatch watch;
    bench.Begin(stop);
    const double round = watch.Seconds(), left = options.seconds - all.Seconds();
    const auto scenes = double(options.scenes.size() - i);
    const double minimum = round * ((kMinRepeats + 1) * scenes - 1);
    if (!on_scene({i, minimum, std::max(minimum, left)})) break;
    const double max_seconds = round + left / scenes;
    for (int repeats = 0; !stop; ++repeats) {
      const bool enough = repeats >= kMinRepeats;
      if (enough && (MaxRelativeHalfWidth(bench.rows()) <= options.within ||
                     watch.Seconds() >= max_seconds))
        break;
      bench.Repeat(stop);
    }
    for (ThroughputRow& row : bench.rows()) {
      if (!row.seconds.empty()) rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace lanelight
