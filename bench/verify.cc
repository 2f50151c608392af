#include "bench/verify.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "src/core/error.h"
#include "src/image/exr.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Mean of one channel and its standard error.
struct ChannelMean {
  double mean = 0, error = 0;
};

ChannelMean OfFilm(const FilmAccumulator& film, int channel) {
  ChannelMean out;
  for (int y = film.y0(); y < film.y0() + film.height(); ++y) {
    for (int x = film.x0(); x < film.x0() + film.width(); ++x) {
      out.mean += film.Mean(x, y)[channel];
      out.error += film.Variance(x, y)[channel];
    }
  }
  const double pixels = double(film.width()) * film.height();
  return {out.mean / pixels, std::sqrt(out.error) / pixels};
}

// The two halves scatter independently about the truth: the error of their mean is half
// the deviation of their difference.
ChannelMean OfReferences(const Image& a, const Image& b, int channel) {
  ChannelMean out;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double va = a.At(x, y, channel), vb = b.At(x, y, channel);
      out.mean += (va + vb) / 2;
      out.error += (va - vb) * (va - vb) / 4;
    }
  }
  const double pixels = double(a.width) * a.height;
  return {out.mean / pixels, std::sqrt(out.error) / pixels};
}

}  // namespace

Verdict VerifyAgainstReference(const Job& job, const std::string& scene,
                               double tolerance) {
  FilmAccumulator film = MakeFilm(job);
  const RunResult result = RunJob(job, film);
  if (result.health.Total() > 0) {
    return {false, fmt::format("WRONG: {} invalid samples", result.health.Total())};
  }
  const fs::path folder = fs::path(scene).parent_path();
  if (!fs::exists(folder / "reference-a.exr") ||
      !fs::exists(folder / "reference-b.exr")) {
    return {true, "not verified: no reference beside the scene"};
  }
  const Image a = ReadExr((folder / "reference-a.exr").string(), {"R", "G", "B"});
  const Image b = ReadExr((folder / "reference-b.exr").string(), {"R", "G", "B"});
  if (a.width != film.width() || a.height != film.height() || b.width != a.width ||
      b.height != a.height) {
    return {true,
            fmt::format("not verified: the reference has {}x{} pixels, the render {}x{}",
                        a.width, a.height, film.width(), film.height())};
  }
  double worst = 0, allowed = 0;
  bool good = true;
  for (int c = 0; c < 3; ++c) {
    const ChannelMean ours = OfFilm(film, c), theirs = OfReferences(a, b, c);
    const double difference = std::abs(ours.mean - theirs.mean) / theirs.mean;
    const double limit =
        tolerance + 3 * std::hypot(ours.error, theirs.error) / theirs.mean;
    good &= difference <= limit;  // false for NaN
    if (!(difference < worst)) {
      worst = difference;
      allowed = limit;
    }
  }
  return {good,
          fmt::format("{}: channel means differ from the reference by {:.2f} % at most "
                      "(limit {:.2f} %)",
                      good ? "verified" : "WRONG", 100 * worst, 100 * allowed)};
}

}  // namespace lanelight
