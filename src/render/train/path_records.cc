#include "src/render/train/path_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "src/base/core/check.h"
#include "src/scene/compiled/view.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

PathRecord ReadRecord(const float* next) {
  PathRecord record;
  for (PathRecord::Vertex& v : record.vertices) {
    v.cell = std::bit_cast<std::uint32_t>(*next++);
    v.at = *next++;
    v.got = *next++;
    v.light = std::bit_cast<std::uint32_t>(*next++);
    v.direct = *next++;
  }
  record.end = *next++;
  return record;
}

double Square(double x) { return x * x; }

// From the square of what kernels call brightness to that of a sample's: the exposure,
// and the weight of the pixel filter.
double ScaleOf(const TrainingSamples& samples, const float channel[3]) {
  double of_colors = 0, of_records = 0;
  for (std::size_t i = 0; i < samples.colors.size(); ++i) {
    const Vec3f& c = samples.colors[i];
    of_colors += Square(channel[0] * c.x + channel[1] * c.y + channel[2] * c.z);
    of_records += Square(samples.recorded[2 * i]);
  }
  return of_records > 0 ? of_colors / of_records : 0;
}

}  // namespace

PathSamples ReadRecords(TrainingSamples samples) {
  PathSamples out{std::move(samples), {}};
  if (out.planes == 0) return out;
  LL_CHECK_EQ(out.planes, NumPlanes(PlaneGroup::kRecord));
  out.records.reserve(out.colors.size());
  for (std::size_t i = 0; i < out.colors.size(); ++i) {
    out.records.push_back(ReadRecord(out.recorded.data() + i * std::size_t(out.planes)));
  }
  out.recorded = {};
  return out;
}

PilotImage EstimatePilotImage(const PreparedScene& scene, const TrainingSamples& samples,
                              const TrainingWork& work) {
  return {std::uint32_t(scene.view->film.width), std::uint32_t(scene.view->film.height),
          work.pixels, samples.colors};
}

double VarianceOfMean(const TrainingSamples& samples, const TrainingWork& work,
                      const PilotImage& image, std::span<const std::size_t> places) {
  const std::uint32_t n = samples.observations;  // of a pixel
  Vec3d sum, squares, weight;
  for (std::uint32_t k = 0; k < n; ++k) {
    Vec3d of_one;
    for (const std::size_t i : places) {
      // Randomisations take turns (src/vocabulary/path/replicates.h).
      for (std::uint32_t j = k; j < work.spp; j += n) {
        of_one += VecCast<double>(samples.colors[i * work.spp + j]);
      }
    }
    sum += of_one;
    squares += of_one * of_one;
  }
  double variance = 0;
  for (int c = 0; c < 3; ++c) {
    for (const std::size_t i : places) {
      weight[c] += image.ErrorWeight(work.pixels[i], c);
    }
    // Scatter of the sum over an observation, per sample.
    const double scatter = std::max(0.0, squares[c] - sum[c] * sum[c] / n) * n;
    variance += scatter / (n - 1) / work.spp * weight[c] / 3;
  }
  const double pixels = double(places.size());
  return variance / (pixels * pixels * pixels);
}

std::vector<double> RelativeVariances(const TrainingSamples& samples,
                                      const TrainingWork& work, const PilotImage& image) {
  std::vector<double> variances;
  for (std::size_t i = 0; i < work.pixels.size(); ++i) {
    variances.push_back(VarianceOfMean(samples, work, image, std::span(&i, 1)));
  }
  return variances;
}

double MomentsAbout(const PathValues& values, float exposure, std::uint32_t pixel) {
  double about = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double inverse = values.inverse_pixel[std::size_t{pixel} * 3 + c];
    if (!(inverse > 0)) return 0;
    about += 1 / (3 * std::sqrt(3.0) * inverse);
  }
  return about / exposure;
}

std::vector<double> SinglePathVariances(const TrainingSamples& samples,
                                        const TrainingWork& work, const PilotImage& image,
                                        const PathValues& values, float exposure,
                                        std::vector<double> variances) {
  LL_CHECK_EQ(samples.planes, NumPlanes(PlaneGroup::kSinglePath));
  const double scale = ScaleOf(samples, values.channel);
  for (std::size_t i = 0; i < variances.size(); ++i) {
    const double about = MomentsAbout(values, exposure, work.pixels[i]);
    double weight = 0, added = 0;
    for (int c = 0; c < 3; ++c) {
      weight += image.ErrorWeight(work.pixels[i], c) / 3 / Square(3 * values.channel[c]);
    }
    for (std::size_t k = i * work.spp; k < (i + 1) * work.spp; ++k) {
      added += samples.recorded[2 * k + 1] - Square(samples.recorded[2 * k] - about);
    }
    variances[i] += added / work.spp * scale * weight;
  }
  return variances;
}

}  // namespace lanelight
