#include "bench/calibrate/truth.h"

#include <algorithm>
#include <memory>

#include "bench/calibrate/every_strategy.h"
#include "bench/calibrate/options.h"
#include "src/measure/study/reference.h"
#include "src/render/films/colors.h"

namespace lanelight::bench {
namespace {

constexpr std::uint64_t kReferenceSeed = 0x5eed5eed;  // renders have 1, 2, ...
constexpr std::uint64_t kTrialSpp = 64;
constexpr double kMaxReferenceFactor = 1024;  // times kMinReferenceSpp

// Rows of an image, means and variances.
Reference FromFilm(const FilmAccumulator& film, std::uint64_t spp) {
  Reference reference;
  reference.width = film.width();
  reference.height = film.height();
  reference.mean = FilmColors(film);
  for (int y = film.y0(); y < film.y0() + film.height(); ++y) {
    for (int x = film.x0(); x < film.x0() + film.width(); ++x) {
      reference.variance.push_back(film.Variance(x, y));
    }
  }
  reference.spp = spp;
  return reference;
}

}  // namespace

Strategy ParseStrategy(const std::string& text) {
  Strategy strategy;
  if (text == kDefaultName) return strategy;
  ApplyStrategy(text, {std::make_shared<const std::string>("--strategies"), 0, 0},
                strategy);
  return strategy;
}

Job JobWith(Job job, const std::string& strategy, std::uint64_t spp) {
  job.spp = spp;
  job.target = {};
  job.seconds = 0;
  return WithStrategy(std::move(job), ParseStrategy(strategy));
}

Measurement TrueErrors(const FilmAccumulator& film, const Reference& reference) {
  Measurement m;
  MeasureErrors(FilmColors(film), reference, m);
  return m;
}

Reference MakeReference(const Job& scene, std::uint64_t spp, double seconds) {
  Job job = JobWith(scene, "points=sobol", kTrialSpp);
  job.seed = kReferenceSeed;
  if (spp == 0) {  // a short render says how long samples take
    const double fit = seconds / RunJob(job).result.seconds * double(kTrialSpp);
    spp = kMinReferenceSpp *
          std::uint64_t(std::clamp(fit / kMinReferenceSpp, 1.0, kMaxReferenceFactor));
  }
  job.spp = spp;
  FilmAccumulator film = RunJob(job).film;
  return FromFilm(film, spp);
}

}  // namespace lanelight::bench
