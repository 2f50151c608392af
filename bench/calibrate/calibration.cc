#include "bench/calibrate/calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "src/base/core/error.h"
#include "src/measure/study/runs.h"
#include "src/render/estimate/estimate.h"

namespace lanelight::bench {
Calibration::Calibration(const CalibrateOptions& options)
    : options_(options), strategies_(options.strategies), end_(60 * options.minutes) {
  for (const std::string& text : strategies_) ParseStrategy(text);
}

void Calibration::Run() {
  std::size_t left = options_.scenes.size() * options_.resolutions.size();
  for (const std::string& resolution : options_.resolutions) {
    for (const std::string& path : options_.scenes) {
      Scene(path, resolution, end_.Share(double(left--)));
    }
  }
  PrintTotals();
}

void Calibration::Scene(const std::string& path, const std::string& resolution,
                        const Deadline& deadline) {
  const std::string name = SceneName(path) + " " + resolution;
  const std::size_t cases =
      options_.targets.empty() ? options_.spp.size() : options_.targets.size();
  if (end_.Over()) {
    left_out_ += strategies_.size() * cases;
    return;
  }
  RenderSettings settings;
  settings.resolution = ParseResolution(resolution);
  settings.spp = 1;
  settings.skip_unsupported = true;
  try {
    const Job job = PrepareJob(path, settings);
    const Reference reference =
        MakeReference(job, options_.reference_spp, deadline.Left() / 4);
    fmt::print("\n{}, reference {} spp, its own relmse {:.2g}\n", name, reference.spp,
               reference.OwnRelMse());
    Rows(job, name, reference, deadline);
  } catch (const InputError& error) {
    fmt::print("\n{}: {}\n", name, error.what());
  }
}

void Calibration::Rows(const Job& job, const std::string& scene,
                       const Reference& reference, const Deadline& deadline) {
  const bool stops = !options_.targets.empty();
  const std::size_t cases = stops ? options_.targets.size() : options_.spp.size();
  if (!stops) {
    fmt::print("{:<48} {:<7}{} {}\n", "", "", Coverage::CountsHead(),
               Coverage::SizesHead());
  }
  std::size_t left = cases * strategies_.size();
  for (std::size_t i = 0; i < cases; ++i) {
    for (const std::string& strategy : strategies_) {
      const Deadline allotted = deadline.Share(double(left--));
      if (end_.Over()) {
        ++left_out_;
      } else if (stops) {
        Stops(job, strategy, options_.targets[i], reference, allotted);
      } else {
        ErrorCoverage row;
        Row(job, strategy, options_.spp[i], reference, allotted, row);
        AddTotals(scene, strategy, options_.spp[i], row, reference);
      }
    }
  }
}

void Calibration::Row(const Job& scene, const std::string& strategy, std::uint64_t spp,
                      const Reference& reference, const Deadline& deadline,
                      ErrorCoverage& out) {
  const std::string name = fmt::format("{}, {} spp", strategy, spp);
  Job job;
  try {
    job = JobWith(scene, strategy, spp);
  } catch (const InputError& error) {
    fmt::print("{:<48} {}\n", name, error.what());
    return;
  }
  for (int seed = 1; seed <= options_.seeds; ++seed) {
    if (seed > options_.min_seeds && deadline.Over()) break;
    job.seed = static_cast<std::uint64_t>(seed);
    FilmAccumulator film = RunJob(job).film;
    const ErrorEstimate stated = EstimateError(film);
    if (!stated.available) {
      fmt::print("{:<48} states no error: too few samples\n", name);
      return;
    }
    const Measurement truth = TrueErrors(film, reference);
    out.relmse.Add(truth.relmse, stated.relmse);
    out.rmse.Add(std::sqrt(std::max(0.0, truth.mse)), stated.rmse);
  }
  fmt::print("{:<48} {:<7}{} {}\n", name, "relmse", out.relmse.Counts(),
             out.relmse.Sizes(reference.OwnRelMse()));
  fmt::print("{:<48} {:<7}{} {}\n", name, "rmse", out.rmse.Counts(),
             out.rmse.Sizes(std::sqrt(reference.OwnMse())));
  std::fflush(stdout);
}

void Calibration::AddTotals(const std::string& scene, const std::string& strategy,
                            std::uint64_t spp, const ErrorCoverage& row,
                            const Reference& reference) {
  if (row.relmse.renders() == 0) return;
  if (reference.OwnRelMse() > kMaxOwnError * row.relmse.MeanTruth() ||
      std::sqrt(reference.OwnMse() / kMaxOwnError) > row.rmse.MeanTruth()) {
    ++coarse_;
    return;
  }
  by_scene_.Add(scene, row);
  by_strategy_.Add(strategy, row);
  by_spp_.Add(fmt::format("{} spp", spp), row);
  all_.Add(row);
}

void Calibration::PrintTotals() const {
  fmt::print("\n");
  if (!options_.targets.empty()) {
    fmt::print("reached by {} of {} that stopped\n", all_reached_, all_stopped_);
  } else {
    by_scene_.Print("scene");
    by_strategy_.Print("strategy");
    by_spp_.Print("samples per pixel");
    by_strategy_.PrintTable("strategy");
    fmt::print("\n{:<48} {:<7}{}\n", "", "", Coverage::CountsHead());
    PrintCounts("all", all_);
    fmt::print("\n{}\n{}\n", all_.relmse.Sentence("relmse"), all_.rmse.Sentence("rmse"));
  }
  if (coarse_ > 0) {
    fmt::print(
        "{} rows are in none of these totals: the reference's own squared error is "
        "more than {:g} of theirs\n",
        coarse_, kMaxOwnError);
  }
  if (left_out_ > 0) {
    fmt::print("{} rows were left out: --minutes {:g} were over\n", left_out_,
               options_.minutes);
  }
}

}  // namespace lanelight::bench
