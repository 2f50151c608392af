#include "src/advise/rare_samples.h"

#include <algorithm>
#include <vector>

#include "src/image/colors.h"
#include "src/core/clock.h"
#include "src/estimate/estimate.h"

namespace lanelight {
namespace {

// Pilot passes as those of a long render.
constexpr std::uint64_t kPlannedSpp = 32;

double MedianAround(const std::vector<Rgb>& means, int width, int height, int x, int y,
                    int channel) {
  double values[9];
  int count = 0;
  for (int b = std::max(0, y - 1); b <= std::min(height - 1, y + 1); ++b) {
    for (int a = std::max(0, x - 1); a <= std::min(width - 1, x + 1); ++a) {
      values[count++] = means[static_cast<std::size_t>(b) * width + a][channel];
    }
  }
  std::nth_element(values, values + count / 2, values + count);
  return values[count / 2];
}

// Relative variance of each pixel.
std::vector<double> PixelErrors(const FilmAccumulator& film) {
  const std::vector<Rgb> means = FilmColors(film);
  std::vector<double> errors;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const Rgb variance = film.Variance(film.x0() + x, film.y0() + y);
      double error = 0;
      for (int c = 0; c < 3; ++c) {
        const double m = MedianAround(means, film.width(), film.height(), x, y, c);
        error += variance[c] / (m * m + kRelativeEpsilon) / 3;
      }
      errors.push_back(error);
    }
  }
  return errors;
}

double Sum(std::vector<double>::const_iterator begin,
           std::vector<double>::const_iterator end) {
  double sum = 0;
  for (auto it = begin; it != end; ++it) sum += *it;
  return sum;
}

}  // namespace

bool AddWholeImage(Job& job, const Strategy& strategy, std::uint64_t seed,
                   const std::atomic<bool>* stop, WholeImage& sum) {
  job.spp = kRareSpp;
  SetStrategy(job, strategy);
  FilmAccumulator film = MakeFilm(job);
  RunOptions options;
  options.spp = kRareSpp;
  options.seed = seed;
  options.stop = stop;
  options.profile = false;
  options.planned_samples = kPlannedSpp * job.window.pixels();
  const double start = ProcessCpuSeconds();
  const RunResult run = Run(job.scene, job.plan, options, film);
  const double seconds = ProcessCpuSeconds() - start;
  if (stop != nullptr && *stop) return false;
  const double render_share = run.seconds > 0 ? 1 - run.pilot_seconds / run.seconds : 1;
  std::vector<double> errors = PixelErrors(film);
  const auto worst = static_cast<std::ptrdiff_t>(kRareTrimmed * double(errors.size()));
  std::nth_element(errors.begin(), errors.begin() + worst, errors.end(),
                   std::greater<double>());
  const double n = double(errors.size());
  const double trimmed = Sum(errors.begin() + worst, errors.end()) / n;
  sum.trimmed += trimmed;
  sum.all += trimmed + Sum(errors.begin(), errors.begin() + worst) / n;
  sum.seconds += seconds * render_share;
  return true;
}

double RareGain(const WholeImage& baseline, const WholeImage& other) {
  const double all = other.all * other.seconds;
  const double trimmed = other.trimmed * other.seconds;
  if (!(all > 0) || !(trimmed > 0)) return 0;
  return std::min(baseline.all * baseline.seconds / all,
                  baseline.trimmed * baseline.seconds / trimmed);
}

}  // namespace lanelight
