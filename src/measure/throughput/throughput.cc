#include "src/measure/throughput/throughput.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "kernels/simd/target.h"
#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/measure/throughput/bench_scenes.h"
#include "src/render/job/job.h"

namespace lanelight {
namespace {

// Rounding, and paths that went another way for it, between targets.
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

// Renders it once, and returns the mean of the image.
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
      : options_(options), scene_(scene) {
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

  /// Warms caches and checks images.
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
      Render(JobOf(i), rows_[i], stop);
      if (stop) return;
      ThroughputRow& row = rows_[i];
      row.seconds.push_back(row.counts.seconds);
      row.cpu_seconds.push_back(row.counts.cpu_seconds);
      row.waiting_seconds += std::max(0.0, row.counts.waiting_seconds);
    }
  }

  double Worst() const {
    double worst = 0;
    for (const ThroughputRow& row : rows_) worst = std::max(worst, row.Spread());
    return worst;
  }
  std::vector<ThroughputRow>& rows() { return rows_; }

 private:
  const Job& JobOf(std::size_t row) const { return jobs_[row / options_.threads.size()]; }
  ThroughputRow RowOf(const Job& job, int threads) const {
    ThroughputRow row;
    row.scene = scene_;
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
  std::vector<Job> jobs_;  // by target: each has trees of its own
  std::vector<ThroughputRow> rows_;
};

struct GroupOfStages {
  const char *begins, *group;
};
// By how names of stages begin; what is not here is "other".
constexpr GroupOfStages kGroups[] = {
    {"generate", "generate"},    {"camera_", "generate"},
    {"points_", "generate"},     {"antithetic_", "generate"},
    {"intersect_", "closest"},   {"shadow_", "shadow"},
    {"surface_", "surface"},     {"shade_", "shade"},
    {"texture", "shade"},        {"mix", "shade"},
    {"light_", "lights"},        {"emission_", "lights"},
    {"escape", "lights"},        {"connect", "lights"},
    {"accumulate", "film"},      {"film", "film"},
    {"task set-up", "generate"}, {"seen", "lights seen"}};
constexpr const char* kGroupNames[] = {"generate",    "closest", "shadow",
                                       "surface",     "shade",   "lights",
                                       "lights seen", "film",    "other"};

std::string GroupOf(const std::string& stage) {
  for (const GroupOfStages& g : kGroups) {
    if (stage.starts_with(g.begins)) return g.group;
  }
  return "other";
}

// Samples over seconds of either kind.
Interval RateIn(const ThroughputRow& row, const Interval& seconds) {
  const double samples = double(row.counts.samples);
  return {samples / seconds.value, samples / seconds.high, samples / seconds.low};
}

}  // namespace

Interval ThroughputRow::Seconds() const {
  return stat::MedianInterval(seconds, kBenchConfidence);
}

Interval ThroughputRow::Rate() const { return RateIn(*this, Seconds()); }

Interval ThroughputRow::CpuRate() const {
  return RateIn(*this, stat::MedianInterval(cpu_seconds, kBenchConfidence));
}

double ThroughputRow::Waiting() const {
  const double cpu = std::accumulate(cpu_seconds.begin(), cpu_seconds.end(), 0.0);
  const double all = cpu + waiting_seconds;
  return all > 0 ? waiting_seconds / all : 0;
}

double ThroughputRow::Spread() const {
  if (seconds.size() < kLeastRepeats) return std::numeric_limits<double>::infinity();
  const Interval s = Seconds();
  return (s.high - s.low) / (2 * s.value);
}

std::vector<StageGroup> StageGroups(const ThroughputRow& row) {
  std::vector<StageGroup> groups;
  for (const char* name : kGroupNames) groups.push_back({name});
  const auto group_of = [&](const StageProfile& s) -> StageGroup& {
    const std::string name = GroupOf(s.name);
    return *std::find_if(groups.begin(), groups.end(),
                         [&](const StageGroup& g) { return name == g.name; });
  };
  const double ns = 1e9 / double(row.counts.samples);
  for (const StageProfile& s : row.counts.stages) {
    StageGroup& group = group_of(s);
    group.ns_per_sample += ns * s.seconds;
    group.items += s.items;
    group.lane_slots += s.lane_slots;
  }
  // What tasks do beside stages has no lanes.
  for (const StageProfile& s : row.counts.parts) {
    group_of(s).ns_per_sample += ns * s.seconds;
  }
  return groups;
}

std::vector<ThroughputRow> MeasureThroughput(
    const ThroughputOptions& options, const std::atomic<bool>& stop,
    const std::function<void(const BenchProgress&)>& on_progress) {
  std::vector<ThroughputRow> rows;
  BenchProgress progress;
  progress.scenes = options.scenes.size();
  for (const std::string& scene : options.scenes) {
    if (stop) break;
    progress.scene = scene;
    SceneBench bench(options, scene);
    bench.Begin(stop);
    const Stopwatch watch;
    const double most = options.seconds * double(bench.rows().size());
    for (progress.repeats = 0; !stop; ++progress.repeats) {
      const bool enough = progress.repeats >= kLeastRepeats;
      if (enough && (bench.Worst() <= options.within || watch.Seconds() >= most)) break;
      bench.Repeat(stop);
      progress.worst = bench.Worst();
      on_progress(progress);
    }
    ++progress.done;
    for (ThroughputRow& row : bench.rows()) {
      if (!row.seconds.empty()) rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace lanelight
