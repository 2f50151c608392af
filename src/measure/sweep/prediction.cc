#include "src/measure/sweep/runner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "src/base/core/parallel.h"
#include "src/measure/sweep/cell_render.h"
#include "src/measure/sweep/sweep_folder.h"

namespace lanelight {
namespace {

constexpr double kProbeSeconds = 0.2;  // of each
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kReportBytes = 12e3;

// A compiled scene with a strategy.
struct Combination {
  std::string scene, strategy;
  const SweepCell* cell;  // the first of it
};

std::string StrategyOf(const SweepCell& cell) {
  return Get(cell.values, Axis::kStrategy).value_or("");
}

// Returns the samples per pixel of a cell; `pixel_seconds`: for one sample of all pixels.
double SamplesOf(const RenderSettings& settings, const ProbeRender& probe,
                 double pixel_seconds) {
  double spp = double(settings.spp.value_or(probe.spp));
  if (!settings.seconds && !HasTarget(settings)) return spp;
  if (!settings.spp) spp = std::numeric_limits<double>::infinity();
  if (settings.seconds) spp = std::min(spp, *settings.seconds / pixel_seconds);
  if (settings.target_relmse) spp = std::min(spp, probe.relmse / *settings.target_relmse);
  if (settings.target_rmse) {
    spp = std::min(spp, probe.mse / (*settings.target_rmse * *settings.target_rmse));
  }
  return std::isfinite(spp) ? std::max(1.0, spp) : kUnknown;
}

class Predictor {
 public:
  Predictor(const Sweep& sweep, const std::string& out, const std::atomic<bool>& stop)
      : sweep_(sweep), folder_(out, sweep), stop_(stop), renderer_(sweep) {}

  SweepPrediction Predict(std::size_t max_probes) {
    SweepPrediction out;
    FindCombinations(out);
    RenderProbes(max_probes, out);
    std::set<std::string> begun;
    for (const SweepCell& cell : sweep_.cells) {
      CellPrediction& p = out.cells[cell.index];
      if (p.done) continue;
      PredictCell(cell, begun.insert(renderer_.SceneKey(cell)).second, p);
    }
    return out;
  }

 private:
  void FindCombinations(SweepPrediction& out) {
    std::set<std::pair<std::string, std::string>> seen;
    out.cells.resize(sweep_.cells.size());
    ParallelFor(out.cells.size(), [&](std::size_t i) {
      out.cells[i].done = folder_.ReadCell(sweep_.cells[i]).state == CellState::kDone;
    });
    for (const SweepCell& cell : sweep_.cells) {
      if (out.cells[cell.index].done || !CellRenderer::HasTarget(cell)) continue;
      const std::string scene = renderer_.SceneKey(cell), strategy = StrategyOf(cell);
      if (seen.emplace(scene, strategy).second) {
        combinations_.push_back({scene, strategy, &cell});
      }
    }
    out.combinations = combinations_.size();
  }

  // Renders evenly spaced combinations, to cover all scenes and strategies, in grid
  // order, to compile each scene once.
  void RenderProbes(std::size_t probe_limit, SweepPrediction& out) {
    const std::size_t count = std::min(probe_limit, combinations_.size());
    for (std::size_t i = 0; i < count && !stop_; ++i) {
      const Combination& c = combinations_[i * combinations_.size() / count];
      try {
        const Job job = renderer_.Prepare(*c.cell);
        pilots_[{c.scene, c.strategy}] =
            RenderProbe(job, kProbeSeconds, sweep_.settings.render.image.half);
        ++out.probes;
      } catch (const std::exception& error) {
        failures_[{c.scene, c.strategy}] = error.what();
      }
    }
  }

  double SampleSeconds(const std::string& scene, const std::string& strategy) const {
    const auto own = pilots_.find({scene, strategy});
    if (own != pilots_.end()) return own->second.sample_seconds;
    double ratio = 0;
    int count = 0;
    for (const auto& [key, probe] : pilots_) {
      if (key.second != strategy) continue;
      ratio += std::log(probe.sample_seconds) - MeanLog(key.first);
      ++count;
    }
    return std::exp(MeanLog(scene) + (count > 0 ? ratio / count : 0));
  }

  // Returns the mean logarithm of seconds per sample over probes of the scene, or over
  // all probes if the scene has none. NaN without probes.
  double MeanLog(const std::string& scene) const {
    double sum = 0, all = 0;
    int count = 0;
    for (const auto& [key, probe] : pilots_) {
      all += std::log(probe.sample_seconds);
      if (key.first != scene) continue;
      sum += std::log(probe.sample_seconds);
      ++count;
    }
    return count > 0 ? sum / count : all / double(pilots_.size());
  }

  // Returns a probe of the scene and strategy; else of the scene; else any; null without.
  const ProbeRender* Nearest(const std::string& scene,
                             const std::string& strategy) const {
    const auto own = pilots_.find({scene, strategy});
    if (own != pilots_.end()) return &own->second;
    for (const auto& [key, probe] : pilots_) {
      if (key.first == scene) return &probe;
    }
    return pilots_.empty() ? nullptr : &pilots_.begin()->second;
  }

  void PredictCell(const SweepCell& cell, bool first_of_scene, CellPrediction& p) const {
    const std::string scene = renderer_.SceneKey(cell), strategy = StrategyOf(cell);
    const auto failure = failures_.find({scene, strategy});
    if (failure != failures_.end()) {
      p.message = failure->second;
      return;
    }
    p.seconds = p.bytes = kUnknown;
    const ProbeRender* probe = Nearest(scene, strategy);
    if (probe == nullptr) return;
    p.measured = pilots_.count({scene, strategy}) > 0;
    RenderSettings settings = sweep_.settings.render;
    ApplyValues(cell.values, settings);
    const double pixel_seconds = SampleSeconds(scene, strategy) * probe->pixels;
    p.seconds = SamplesOf(settings, *probe, pixel_seconds) * pixel_seconds;
    if (first_of_scene) p.seconds += probe->load_seconds + probe->build_seconds;
    p.bytes = probe->bytes_per_pixel * probe->pixels + kReportBytes;
    if (settings.image.png) p.bytes += 3 * probe->pixels;  // at most
  }

  const Sweep& sweep_;
  SweepFolder folder_;
  const std::atomic<bool>& stop_;
  CellRenderer renderer_;
  std::vector<Combination> combinations_;
  std::map<std::pair<std::string, std::string>, ProbeRender> pilots_;  // scene, strategy
  std::map<std::pair<std::string, std::string>, std::string> failures_;
};

}  // namespace

SweepPrediction Predict(const Sweep& sweep, const std::string& out, int max_probes,
                        const std::atomic<bool>& stop) {
  return Predictor(sweep, out, stop).Predict(std::size_t(max_probes));
}

}  // namespace lanelight
